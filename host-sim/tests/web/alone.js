// The page without a server, for its tests: the folder made by stiction-page, from a minimal server or as a file.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const workspace = fileURLToPath(new URL("../../../", import.meta.url));
const target = process.env.CARGO_TARGET_DIR ?? join(workspace, "target");
/** Folders of the page and of the npm package. */
export const folder = process.env.STICTION_PAGE ?? join(target, "page");
export const npm = process.env.STICTION_NPM ?? join(target, "npm");

/** Reason why the tests cannot run here, or false. */
export const missingPage =
  existsSync(join(folder, "index.html")) && existsSync(join(npm, "package.json"))
    ? false
    : `no ${folder} or ${npm}: type cargo run --release -p stiction-page -- --out ${folder} --npm ${npm}`;
if (missingPage && process.env.CI === "true") throw new Error(missingPage);

/** Content types of a web host. */
const KINDS = /** @type {{[end: string]: string}} */ ({
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
});

/** A host that serves a folder and nothing else; it has the parts of a program that a `Bench` needs. */
export class Host {
  /** @param {import("node:http").Server} server */
  constructor(server) {
    this.server = server;
    this.said = "";
    const { port } = /** @type {import("node:net").AddressInfo} */ (server.address());
    this.origin = `http://127.0.0.1:${port}`;
  }

  /** @param {string} root */
  static async start(root = folder) {
    const server = createServer((request, response) => {
      const path = new URL(request.url ?? "/", "http://localhost").pathname;
      const file = join(root, path === "/" ? "index.html" : path);
      if (!existsSync(file)) {
        response.writeHead(404).end();
        return;
      }
      response.writeHead(200, { "content-type": KINDS[extname(file)] ?? "text/plain" }).end(readFileSync(file));
    });
    await new Promise((done) => server.listen(0, "127.0.0.1", () => done(undefined)));
    return new Host(server);
  }

  /** Stops the host. */
  async kill() {
    this.server.closeAllConnections();
    await new Promise((done) => this.server.close(done));
  }
}

/** The page as a single file, opened from the disk. */
export const oneFile = pathToFileURL(join(folder, "stiction.html")).href;

/** Asserts that a value exists. @template T @param {T | null | undefined} value @returns {T} */
export function there(value) {
  assert.ok(value !== null && value !== undefined);
  return value;
}

/** The files that a page asks for until its first drawing, the worker's included. @param {import("./live.js").Live} live */
export async function filesOfFirstDrawing(live) {
  const names = await live.page.evaluate(() => {
    const [{ startTime: drawn }] = performance.getEntriesByName("first-drawing");
    const files = performance.getEntriesByType("resource").filter(({ startTime }) => startTime < drawn);
    return files.map(({ name }) => new URL(name).pathname);
  });
  return [...new Set(["/index.html", "/worker.js", "/stiction.wasm", ...names])];
}
