// Events of the body, by name.

/** In the order of their codes on the wire (FRAME 5.3). */
export const EVENTS = ["touch", "lift", "slip", "tip", "land", "snap", "jam", "slide", "stop", "grasp", "release"];

/** Meaning of each of them (STATICS 7 and 8). @type {{[event: string]: string}} */
export const MEANINGS = {
  touch: "a vertex came to a surface",
  lift: "a contact opened without another one taking over its motion",
  slip: "a slip ended at |T| = µd N; several in one tick count one by one",
  tip: "the object left an edge and turns about one of its vertices",
  land: "a second vertex came to the surface: the object lies on an edge",
  snap: "the balance of moments folded and the object snapped to the next one",
  jam: "a contact more: three or more fix the object",
  slide: "a contact began to slide with the hand",
  stop: "a contact that slid with the hand sticks again",
  grasp: "the hand took hold of the object",
  release: "the hand let go of the object",
};
