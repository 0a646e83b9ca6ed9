// The hand: its pose, its hold, and the samples that are sent. It never jumps: it moves open to the point of a hold, is seen
// there, and only then closes.

/** Interval of samples of a hand that stands still during a drag (ms), so that this page keeps it. */
const KEEP_ALIVE = 2000;
/** Time without a sample after which the frames have caught up (ms). */
const SETTLED = 400;
/** Time (ms) and ticks after which a hold without success is out of reach. */
const TOO_LATE = 600;
const TOO_MANY = 50;
/** Tolerance of the hand's position in a frame (m): the solver may have rounded it. */
const NEAR = 1e-6;

export class Grip {
  /**
   * @param {() => Feed} feed @param {(text: string) => void} tell @param {() => string | null} refusal why the hand
   * cannot be had now
   * @param {() => void} tried called when the reader takes the hand
   */
  constructor(feed, tell, refusal, tried) {
    this.feed = feed;
    this.tell = tell;
    this.refusal = refusal;
    this.tried = tried;
    /** Target pose of the hand. @type {Pose} */
    this.pose = [0, 0, 0];
    /** Target state: the hand holds. */
    this.held = false;
    /**
     * Phase before a hold: releases the previous hold, or moves open to the point.
     * @type {"releasing" | "reaching" | null}
     */
    this.phase = null;
    /** Pose where it closes. @type {Pose} */
    this.place = [0, 0, 0];
    /** A pointer or a key is down. */
    this.active = false;
    /** Offset from the leading pointer to the hand (m); null: determined at the pointer's next sample. @type {Vec | null} */
    this.offset = null;
    /** The hand stays closed when the pointer is released. */
    this.keep = false;
    this.lastSent = -Infinity;
    /** Time and tick of closing, until a frame shows the hold. */
    this.closedAt = Infinity;
    this.closedTick = 0;
    /** The newest frame. @type {FrameMessage | null} */
    this.frame = null;
    setInterval(() => this.keepAlive(), KEEP_ALIVE / 2);
  }

  /** True while the hand holds the body, according to the newest frame. */
  get holding() {
    return this.frame?.holding != null;
  }

  /** Takes a new frame: its hand is adopted, unless this page moves it. @param {FrameMessage} message */
  take(message) {
    const back = this.frame !== null && message.frame.t < this.frame.frame.t;
    this.frame = message;
    if (back) this.startAnew();
    if (this.phase === "releasing" && !this.holding) this.reach(performance.now());
    else if (this.phase === "reaching" && this.isThere(message.frame.hand)) this.close(performance.now());
    if (this.holding) {
      this.closedAt = Infinity;
    } else if (performance.now() - this.closedAt > TOO_LATE && message.tick - this.closedTick > TOO_MANY) {
      this.closedAt = Infinity;
      this.tell("The hand is too far from the object to hold it.");
    }
    this.adopt();
  }

  /** After a reset or in another scene, adopts the hand of the newest frame whatever this page wanted before. */
  startAnew() {
    this.phase = null;
    this.offset = null;
    this.closedAt = Infinity;
    this.lastSent = -Infinity;
    this.follow();
  }

  /** Adopts the hand of the newest frame, if this page has not moved it recently. */
  adopt() {
    if (!this.active && !this.phase && performance.now() - this.lastSent >= SETTLED) this.follow();
  }

  /** Adopts the hand of the newest frame. */
  follow() {
    if (!this.frame) return;
    const [x, y, phi] = this.frame.frame.hand;
    this.pose = [x, y, phi];
    this.held = this.holding;
  }

  /** Returns false, and shows the reason, if the hand is not available. */
  mayMove() {
    const why = this.refusal();
    if (why) this.tell(why);
    else this.adopt();
    this.tried();
    return why === null;
  }

  /** Begins to move, with the present hold. @param {number} sent */
  begin(sent) {
    if (!this.mayMove()) return false;
    this.active = true;
    if (!this.phase) this.held = this.holding;
    this.send(sent);
    return true;
  }

  /** Grasps the body at a point; releases a hold elsewhere first. @param {Vec} place @param {number} sent */
  grasp(place, sent) {
    if (!this.mayMove()) return false;
    this.active = true;
    if (this.holding) {
      this.open(sent);
      this.phase = "releasing";
    }
    this.pose = [place[0], place[1], this.pose[2]];
    this.place = this.pose;
    if (!this.phase) this.reach(sent);
    return true;
  }

  /**
   * Moves open to the point of a hold: sends two samples, so that the motion takes the time between these two, not the time
   * since the previous sample.
   * @param {number} sent
   */
  reach(sent) {
    this.phase = "reaching";
    this.held = false;
    this.send(sent, this.place);
    this.send(sent, this.place);
  }

  /** Returns true if a frame's hand is at the point of the hold. @param {Pose} hand */
  isThere(hand) {
    return hand.every((value, i) => Math.abs(value - this.place[i]) <= NEAR * (1 + Math.abs(value)));
  }

  /** Closes where it is, and continues to the present position of the pointer. @param {number} sent */
  close(sent) {
    this.phase = null;
    this.held = true;
    this.closedAt = performance.now();
    this.closedTick = this.frame?.tick ?? 0;
    this.send(sent, this.place);
    if (this.pose !== this.place) this.send(sent);
  }

  /** Opens the hand. @param {number} sent */
  open(sent) {
    this.held = false;
    this.phase = null;
    this.closedAt = Infinity;
    this.send(sent);
  }

  /** Holds where the hand is, or lets go. @param {number} sent */
  toggle(sent) {
    if (!this.mayMove()) return;
    if (this.holding) {
      this.open(sent);
      this.rest();
    } else {
      this.place = this.pose;
      this.reach(sent);
    }
  }

  /** Ends the motion when the pointer is released. @param {number} sent @param {boolean} stays the hand stays closed */
  end(sent, stays) {
    this.offset = null;
    if (!stays) this.open(sent);
    else if (!this.phase) this.send(sent);
    this.rest();
  }

  /** Rests; unless it holds, others may take the hand immediately. */
  rest() {
    this.active = false;
    // Without a connection there is nothing to release.
    if (!this.held && !this.phase) this.feed().request({ type: "let-go" }).catch(() => {});
  }

  /** Sets the offset of the hand from the leading pointer, which then stays constant. @param {Vec} point m */
  anchor([x, y]) {
    this.offset = [this.pose[0] - x, this.pose[1] - y];
  }

  /**
   * Follows the leading pointer by position, not by displacement, so that errors do not accumulate.
   * @param {Vec} point m @param {number} sent
   */
  lead(point, sent) {
    if (!this.offset) this.anchor(point);
    const [x, y] = this.offset ?? [0, 0];
    this.pose = [point[0] + x, point[1] + y, this.pose[2]];
    if (!this.phase) this.send(sent);
  }

  /** Moves and turns the hand. @param {number} dx m @param {number} dy m @param {number} turn rad @param {number} sent */
  move(dx, dy, turn, sent) {
    if (dx !== 0 || dy !== 0) this.offset = null;
    this.pose = [this.pose[0] + dx, this.pose[1] + dy, this.pose[2] + turn];
    if (!this.phase) this.send(sent);
  }

  /** Sends one sample. @param {number} sent @param {Pose} pose */
  send(sent, pose = this.pose) {
    this.lastSent = performance.now();
    this.feed().hand(pose, this.held, sent);
  }

  /** Keeps a hand that stands still during a drag with this page. */
  keepAlive() {
    if (this.active && !this.phase && performance.now() - this.lastSent > KEEP_ALIVE) this.send(performance.now());
  }
}
