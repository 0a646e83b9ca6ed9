// The connection to the server: one WebSocket, which reconnects by itself.

import { Talk } from "./talk.js";

/** Time to the next attempt, initial and longest (ms). */
const FIRST_WAIT = 300;
const LONGEST_WAIT = 3000;

export class Link extends Talk {
  /** @param {FeedEvents} events */
  constructor(events) {
    super(events);
    /** @type {WebSocket | null} */
    this.socket = null;
    this.wait = FIRST_WAIT;
    window.addEventListener("online", () => this.connect());
    this.connect();
  }

  /** Connects, unless that is done or in progress. */
  connect() {
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/ws`);
    this.socket = socket;
    socket.addEventListener("open", () => {
      this.wait = FIRST_WAIT;
      this.events.connected(true);
      this.askRate();
    });
    socket.addEventListener("message", ({ data }) => this.take(data));
    socket.addEventListener("close", () => this.lost(socket));
  }

  /**
   * Handles a lost connection: open requests fail, and a new connection is tried.
   * @param {WebSocket} socket
   */
  lost(socket) {
    if (socket !== this.socket) return;
    this.giveUp("The connection was lost.");
    this.events.connected(false);
    setTimeout(() => this.connect(), this.wait);
    this.wait = Math.min(LONGEST_WAIT, 1.5 * this.wait);
  }

  /** Sends, if there is a connection. @param {object} message @returns {boolean} */
  send(message) {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }
}
