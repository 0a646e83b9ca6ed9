// Fingers on a touch screen, for tests: Chromium handles them like those on a phone.

/** Window of a phone. */
export const PHONE = { viewport: { width: 412, height: 800 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 };

export class Fingers {
  /** @param {import("playwright-core").CDPSession} devtools */
  constructor(devtools) {
    this.devtools = devtools;
    /** Positions of the fingers (CSS px). @type {Spot[]} */
    this.points = [];
  }

  /** @param {import("playwright-core").Page} page */
  static async of(page) {
    return new Fingers(await page.context().newCDPSession(page));
  }

  /** @param {"touchStart" | "touchMove" | "touchEnd"} type @param {Spot[]} points */
  async touch(type, points) {
    this.points = points;
    await this.devtools.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map((point, id) => ({ ...point, id })),
    });
  }

  /** Puts all fingers down at these positions. @param {Spot[]} points */
  down(...points) {
    return this.touch("touchStart", points);
  }

  /** Lifts all fingers. */
  lift() {
    return this.touch("touchEnd", []);
  }

  /** Moves every finger along a path, from 0 to 1. @param {(part: number) => Spot[]} path */
  async along(path, steps = 20) {
    for (let k = 1; k <= steps; k++) await this.touch("touchMove", path(k / steps));
  }

  /** Moves the fingers in straight lines. @param {Spot[]} to */
  async glide(...to) {
    const from = this.points;
    await this.along((part) =>
      to.map(({ x, y }, i) => ({ x: from[i].x + (x - from[i].x) * part, y: from[i].y + (y - from[i].y) * part })),
    );
  }
}
