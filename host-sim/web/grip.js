// The hand: where it is, whether it holds, and the samples that say so. Nothing jumps: it goes to the place of a hold
// open, is seen there, and only then closes.

/** A hand that is still under way says so again after so long (ms), so that it stays this page's. */
const KEEP_ALIVE = 2000;
/** The frames have caught up after so long without a sample (ms). */
const SETTLED = 400;
/** A hold that has not come about after so long (ms) and so many ticks is out of reach. */
const TOO_LATE = 600;
const TOO_MANY = 50;
/** A frame shows the hand at a place that is so near (m): the solver may have rounded it. */
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
    /** Where the hand is to be. @type {Pose} */
    this.pose = [0, 0, 0];
    /** It is to hold. */
    this.held = false;
    /**
     * On the way to a hold: gives up the one before, or goes open to the place.
     * @type {"releasing" | "reaching" | null}
     */
    this.phase = null;
    /** Where it is to close. @type {Pose} */
    this.place = [0, 0, 0];
    /** A pointer or a key is down. */
    this.active = false;
    /** From the pointer that leads the hand to the hand (m); null: as they are at the pointer's next sample. @type {Vec | null} */
    this.offset = null;
    /** It stays closed when the pointer lets go. */
    this.keep = false;
    this.lastSent = -Infinity;
    /** When and in which tick it closed, until the hold is seen in a frame. */
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

  /** A new frame: the hand is where it says, unless it is this page that moves it. @param {FrameMessage} message */
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

  /** After a reset or in another scene the hand is where the newest frame says, whatever this page wanted before. */
  startAnew() {
    this.phase = null;
    this.offset = null;
    this.closedAt = Infinity;
    this.lastSent = -Infinity;
    this.follow();
  }

  /** The hand is as the newest frame has it, if this page has not moved it lately. */
  adopt() {
    if (!this.active && !this.phase && performance.now() - this.lastSent >= SETTLED) this.follow();
  }

  /** The hand is as the newest frame has it. */
  follow() {
    if (!this.frame) return;
    const [x, y, phi] = this.frame.frame.hand;
    this.pose = [x, y, phi];
    this.held = this.holding;
  }

  /** False, with the reason told, if the hand cannot be had now. */
  mayMove() {
    const why = this.refusal();
    if (why) this.tell(why);
    else this.adopt();
    this.tried();
    return why === null;
  }

  /** Begins to move, with the hold that there is. @param {number} sent */
  begin(sent) {
    if (!this.mayMove()) return false;
    this.active = true;
    if (!this.phase) this.held = this.holding;
    this.send(sent);
    return true;
  }

  /** Takes hold at a place of the body; a hold elsewhere is given up first. @param {Vec} place @param {number} sent */
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
   * Goes open to the place of a hold: twice, so that it takes the time between these two, not that since the last
   * sample.
   * @param {number} sent
   */
  reach(sent) {
    this.phase = "reaching";
    this.held = false;
    this.send(sent, this.place);
    this.send(sent, this.place);
  }

  /** True if a frame's hand is at the place of the hold. @param {Pose} hand */
  isThere(hand) {
    return hand.every((value, i) => Math.abs(value - this.place[i]) <= NEAR * (1 + Math.abs(value)));
  }

  /** Closes where it is, and goes on to where the pointer is by now. @param {number} sent */
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

  /** The pointer has let go. @param {number} sent @param {boolean} stays the hand stays closed */
  end(sent, stays) {
    this.offset = null;
    if (!stays) this.open(sent);
    else if (!this.phase) this.send(sent);
    this.rest();
  }

  /** Nothing moves the hand any more; unless it holds, others may have it at once. */
  rest() {
    this.active = false;
    // Without a connection there is nothing to be given up.
    if (!this.held && !this.phase) this.feed().request({ type: "let-go" }).catch(() => {});
  }

  /** The pointer that leads the hand is here: from now on the hand stays as far from it. @param {Vec} point m */
  anchor([x, y]) {
    this.offset = [this.pose[0] - x, this.pose[1] - y];
  }

  /**
   * Goes where the pointer leads it: the place counts, not the displacement, so that nothing adds up.
   * @param {Vec} point m @param {number} sent
   */
  lead(point, sent) {
    if (!this.offset) this.anchor(point);
    const [x, y] = this.offset ?? [0, 0];
    this.pose = [point[0] + x, point[1] + y, this.pose[2]];
    if (!this.phase) this.send(sent);
  }

  /** Moves. @param {number} dx m @param {number} dy m @param {number} turn rad @param {number} sent */
  move(dx, dy, turn, sent) {
    if (dx !== 0 || dy !== 0) this.offset = null;
    this.pose = [this.pose[0] + dx, this.pose[1] + dy, this.pose[2] + turn];
    if (!this.phase) this.send(sent);
  }

  /** One sample. @param {number} sent @param {Pose} pose */
  send(sent, pose = this.pose) {
    this.lastSent = performance.now();
    this.feed().hand(pose, this.held, sent);
  }

  /** A hand that is held still stays this page's. */
  keepAlive() {
    if (this.active && !this.phase && performance.now() - this.lastSent > KEEP_ALIVE) this.send(performance.now());
  }
}
