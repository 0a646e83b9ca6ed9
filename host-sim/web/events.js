// What may happen to the body, by name.

/** In the order of their codes on the wire (FRAME 5.3). */
export const EVENTS = ["touch", "lift", "slip", "tip", "land", "snap", "jam", "slide", "stop", "grasp", "release"];
