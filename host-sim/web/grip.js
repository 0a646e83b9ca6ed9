// The hand: where it is, whether it holds, and the samples that say so. It takes hold only where it is, so nothing jumps.

/** A hand that is still under way says so again after so long (ms), so that it stays this page's. */
const KEEP_ALIVE = 2000;
/** The frames have caught up after so long without a sample (ms). */
const SETTLED = 400;
/** A hold that has not come about after so long (ms) and so many ticks is out of reach. */
const TOO_LATE = 600;
const TOO_MANY = 50;

export class Grip {
  /** @param {() => Feed} feed @param {(text: string) => void} tell */
  constructor(feed, tell) {
    this.feed = feed;
    this.tell = tell;
    /** Where the hand is to be. @type {Pose} */
    this.pose = [0, 0, 0];
    /** It is to hold. */
    this.held = false;
    /** A hold elsewhere is being given up first. */
    this.releasing = false;
    /** A pointer or a key is down. */
    this.active = false;
    /** It stays closed when the pointer lets go. */
    this.keep = false;
    this.lastSent = -Infinity;
    /** When it closed, until that is seen in a frame. */
    this.closedAt = Infinity;
    this.closedTick = 0;
    /** The newest frame. @type {FrameMessage | null} */
    this.frame = null;
    setInterval(() => this.keepAlive(), KEEP_ALIVE / 2);
  }

  /** True while the hand holds the body, as the newest frame says. */
  get holding() {
    return this.frame?.holding != null;
  }

  /** A new frame: the hand is where the frame says, unless it is this page that moves it. @param {FrameMessage} message */
  take(message) {
    this.frame = message;
    if (this.releasing && message.holding === null) {
      this.releasing = false;
      this.close(performance.now());
    }
    if (message.holding) this.closedAt = Infinity;
    else if (performance.now() - this.closedAt > TOO_LATE && message.tick - this.closedTick > TOO_MANY) {
      this.closedAt = Infinity;
      this.tell("The hand is too far from the object to hold it.");
    }
    if (!this.active && performance.now() - this.lastSent > SETTLED) this.adopt();
  }

  /** The hand as the newest frame has it. */
  adopt() {
    if (!this.frame) return;
    const [x, y, phi] = this.frame.frame.hand;
    this.pose = [x, y, phi];
    this.held = this.holding;
  }

  /** Begins to move, with the hold that there is. @param {number} sent */
  begin(sent) {
    if (!this.active && performance.now() - this.lastSent > SETTLED) this.adopt();
    this.active = true;
    this.held = this.holding;
    this.send(sent);
  }

  /** Takes hold at a place of the body; a hold elsewhere is given up first. @param {Vec} place @param {number} sent */
  grasp(place, sent) {
    if (!this.active && performance.now() - this.lastSent > SETTLED) this.adopt();
    this.active = true;
    if (this.holding) {
      this.held = false;
      this.send(sent);
      this.releasing = true;
    }
    this.pose = [place[0], place[1], this.pose[2]];
    if (!this.releasing) this.close(sent);
  }

  /** Closes the hand where it is: it goes there open first. @param {number} sent */
  close(sent) {
    this.held = false;
    this.send(sent);
    this.held = true;
    this.closedAt = performance.now();
    this.closedTick = this.frame?.tick ?? 0;
    this.send(sent);
  }

  /** Opens the hand. @param {number} sent */
  open(sent) {
    this.held = false;
    this.releasing = false;
    this.closedAt = Infinity;
    this.send(sent);
  }

  /** The pointer has let go. @param {number} sent */
  end(sent) {
    this.active = false;
    if (!this.keep) this.open(sent);
    else this.send(sent);
  }

  /** Moves. @param {number} dx m @param {number} dy m @param {number} turn rad @param {number} sent */
  move(dx, dy, turn, sent) {
    this.pose = [this.pose[0] + dx, this.pose[1] + dy, this.pose[2] + turn];
    if (!this.releasing) this.send(sent);
  }

  /** One sample. @param {number} sent */
  send(sent) {
    this.lastSent = performance.now();
    this.feed().hand(this.pose, this.held, sent);
  }

  /** A hand that is held still stays this page's. */
  keepAlive() {
    if (this.active && !this.releasing && performance.now() - this.lastSent > KEEP_ALIVE) this.send(performance.now());
  }
}
