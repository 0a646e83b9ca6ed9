//! Whether a trace obeys the laws of statics and friction, judged from nothing but the scene and the trace, from this project
//! or another program. It uses only the solver's printed output and none of its physics; `stiction-scene` reads the scene. Everything is
//! in f64, SI units, world frame. [`insertion`] is the meter of a peg in a hole, from the scene and a frame alone.
//!
//! ```text
//! scene.toml ── scene ─────────────────┐
//! trace.jsonl ─ trace ─ frame by frame ┴───────┬ still (geometry, balance) ── obstacles (sides, corners) ┐
//! trace.csv                                     ├ judge (hold, rest, stick)                               ├ findings ─ survey
//!                                               ├ slip ─ onset, pin, brace (STATICS 3-5) ─────────────────┤
//!                                               ├ slide (contacts that slide)                             │
//!                                               ├ passage (ends of sides, what is passed through)         │
//!                                               └ hold ─ bearing (what could hold, jams) ─────────────────┘
//! ```
//!
//! [`law`] contains the name and the statement of every law, [`Bounds`] the tolerances. STATICS is `core/STATICS.md`.
//!
//! # Events
//!
//! * Contacts appear with `touch`, `land` and `jam` and disappear with `lift` and `tip`, with no other event, and not without one. All
//!   events of a frame, in order, lead from the state of the previous frame to that of this one. Among obstacles, a slip or slide can
//!   replace contacts by others without an event, and so can a contact that becomes flat; their number stays the same.
//! * `slips` and `events` report the same slips. If a frame contains only slips, of a vertex or an edge, their number is that of the slips
//!   that lead from the old position to the new one, each from where static friction gives way to the first position where |T| = mu_d N.
//! * A body for which an event is reported is not where it was, to within 8 roundings, unless it is left out of balance; the same holds for
//!   the contacts of a slip.
//! * The angle of a body that turns about a contact, slides on one, or hangs in the air continues along its branch; `snap` is reported
//!   where the branch folds and nowhere else.
//! * A slide begins at mu_d N: a contact that bore more slips first.
//!
//! # Statuses
//!
//! A status excuses only what its frame shows. `held-last` and `saturated` repeat the previous record except for the time; `event-limit`
//! has 100 slips or a full list of events, and is judged like any other frame; `behind` reports the remaining part of the displacement.
//! `iteration-limit` and `twist` excuse nothing. `ambiguous` is a body with several contacts (or one whose motions follow one another until
//! the list of events is full, or whose contacts open and close four times) that no reactions hold and that has no motion which the load
//! drives and no contact obstructs. `jammed` needs several contacts on more than one line, and reactions that bear the load and exceed half
//! the limit. Out of balance nothing moves, except that a jammed body may turn about a corner.
//!
//! # Sticking
//!
//! A sticking contact stays, to within 8 roundings of the farthest coordinate, at the position where it stopped, over all frames until
//! something happens: creep counts by its sum.
//!
//! # Slides
//!
//! A trace may report for its contacts whether they slide with the hand (`sliding`: -1, 0, 1). Then, and only then,
//!
//! * T = -s mu_d N for a contact that slides along s t, as exactly as at the end of a slip. So its foot is where the law of the slide
//!   places it, and it moves forward: from its farthest position it moves back by no more than a sticking contact may move. Where the
//!   hand's path would lead it back, it has stopped.
//! * Contacts that slide together do so with the signs of one motion of the body: both vertices of an edge in the same direction, two on
//!   two surfaces according to the twist that keeps both there. A velocity whose sign may be due to rounding fits any sign. A vertex in a
//!   corner does not slide, nor do contacts that leave the body no motion.
//! * `slide` and `stop` are reported, unless nothing touches any more. The last of them agrees with the end of the frame, and a `stop` that
//!   comes first agrees with the previous frame.
//! * On one surface, N of a slide does not rise past N* = k_h D_c / (mu_s - mu_d): the slide sticks there (path evolution).
//! * Contacts stick where they are reported to, also with mu_s = mu_d; exceptions are contacts without friction, or without force, since
//!   the body may turn out of the way.
//! * Sticking is bounded by mu_s. A trace does not report whether a body has stiction, or sticks only up to mu_d.
//!
//! # What could have held
//!
//! Two vertices that stick keep the body where it is as long as reactions within friction bear the load. All loads that
//! they bear form a convex cone, and the hand moves straight: if the load is in the cone at the hand's previous and current
//! pose, it is in the cone in between, and the body stays. It is unlawful if it does not, unless the hand alone opens all
//! gaps on its path (STATICS 5). A load counts as borne only with reactions of at most 128 k_h L, twice the limit of status
//! `ok`, and together with all loads that differ from it by 64 roundings of these reactions and by the fraction of its
//! magnitude that the bound on slips allows. The friction is mu_s, but mu_d in a trace that reports slides, as the body may
//! have no stiction; it has stiction if no reactions within mu_d bear the load of the previous frame.
//!
//! A body is `jammed` if the load needs N beyond 64 k_h L. It is not if neither friction, mu_d nor mu_s, needs that: either reactions of
//! half of it bear the load, or none do, however large, since the load drives a twist that opens all contacts. In a trace that reports
//! slides, the status is not `ok` if every combination within mu_s needs more than 17/16 of the limit, which a twist proves.
//!
//! # Obstacles (STATICS 12)
//!
//! A contact is a vertex of the body on a half-plane, or on a side of an obstacle, or a corner of an obstacle on a side of the body, whose
//! normal turns with it ([`Touch`]). The laws of balance, slips, slides and holding use only its point, normal and friction, so these
//! contacts are judged as among half-planes: a sticking corner keeps its position on the body, a sliding one moves forward along it, and
//! its slip ends where |T| = mu_d N in balance. Two contacts on one line are an edge, whatever their kinds; if their frictions differ, each
//! bears in proportion to its N. In addition, among obstacles alone:
//!
//! * Body and obstacle are apart along some axis, within the tolerance for half-planes.
//! * Sides of one direction that lie in one line within 2^-19 L are in that line, and one side if their frictions are equal and they are no
//!   farther apart (STATICS 12, R35).
//! * A contact is between the ends of its side, its side faces what is next to the vertex or corner, and two contacts with one obstacle are not
//!   at the same place. A reported direction is the normal.
//! * Features that touch to within 8 roundings in two consecutive frames are reported as a contact, unless they have opened in between;
//!   exceptions are features at the end of a side, between two contacts on one line, at the place of a contact with the same obstacle, or
//!   at a covered corner.
//! * Without an event, contacts stay, or slide and are replaced at an end of a side: the new contact is next to the old one, on the body
//!   and on the obstacle, no farther than the body has moved.
//! * Nothing passes through a side if its path is known: a body in the air, without events, follows the path of the hand; a body that
//!   sticks on a single contact turns about it. A single contact that dynamic friction holds along the whole path of the hand is not left,
//!   whatever slips, slides and lifts are reported.
//!
//! # What is not judged
//!
//! * Events that cancel each other within a frame, such as `touch` and `lift` of one contact; slips, slides and snaps that occur together
//!   with other events of their frame, and their number.
//! * `snap` of two sliding contacts, or of one that slides on a corner; `snap` of a slide if nothing holds the angle.
//! * Events exactly at the end of a frame, within rounding: they may be reported with this frame or with the next one. The same holds for a
//!   slip that is shorter than the uncertainty of the forces.
//! * The length of a slip more accurately than the position where static friction gives way, which is uncertain if it gives way gradually.
//! * The actions of the hand, if its path is not given: a frame that repeats the previous one, including the hand, with `held-last`.
//! * Which of two neighbouring contacts on an obstacle appeared, if a third one was replaced in the same frame.
//! * In a frame whose list of events is full (16): later events.
//! * The path between two balances in a frame with events: a wrong branch of the angle in balance passes, except after a single slip of a
//!   vertex, which must continue the branch of the previous frame.
//! * Among obstacles, the path of a body in a frame with a touch, or with a slip or slide that may have led past the end of a side: it may
//!   be on the other side of a wall. The same holds for a body that slides or is held by two contacts, for a passage through a side and
//!   back within a 64th of a path, and between the start pose and the first record.
//! * Which of the pairs at one place is reported, and by which of the neighbouring pairs a sliding contact is replaced; whether a vertex
//!   exactly at a corner is a contact. Slips of a flat contact whose ends changed.
//! * When a contact should have yielded or appeared: for half-planes, it is only required that a contact is in its cone and no vertex
//!   inside a surface. When a single vertex, a corner, or sliding contacts should have opened; nor cases that a slip would explain.
//! * The positions of slips of contacts with mu_s = mu_d, in a trace that does not report slides: they slide continuously, and nothing
//!   marks their ends.
//! * In a frame with a single slip and nothing else: a slip of more than two contacts, a slip no longer than rounding, and for two vertices
//!   on two surfaces, whether its end is the first one on the path, and whether both press there. In a trace that reports slides, the slip
//!   may begin at mu_d N instead, except that of an edge, or of a vertex that slides on. If contacts slide on after it, its end.
//! * In a frame with more slips, or slips together with other events: all but the last slip; also the last one if the state is not a vertex
//!   or an edge, if it is not the last event, or if a contact opened before it (the slip may then end out of balance, and the body turn
//!   after it); and the direction of the slip.
//! * Whether a slip should have ended in a slide, and whether a slide should have begun where it did: that depends on the body's stiction.
//!   Slides of two contacts that should have stuck because of the length of the impending slip. D_c of a point, unless the scene gives it.
//! * `slide` and `stop` in frames whose status is not `ok`, or with a contact without friction or force; the reversal of one foot of two.
//! * For a `jammed` body: its reactions and its wrench. For one that is `behind`: everything that depends on the hand, in that frame and
//!   the next one, and how far behind it is.
//! * The balance of a body that no hand holds: it only has to stay.
//! * In rows of CSV that report more than four contacts: everything but springs, geometry and the contacts that are present.

mod bearing;
mod body;
mod brace;
mod events;
mod finding;
mod frame;
mod hold;
pub mod insertion;
mod judge;
mod level;
mod model;
mod obstacles;
mod onset;
mod pairs;
mod passage;
mod pin;
mod scene;
mod shape;
mod sides;
mod slide;
mod slip;
mod status;
mod still;
mod survey;
mod touch;
mod trace;
mod vector;
mod yielding;

pub use body::{centroid, size};
pub use finding::{Bounds, Finding, law};
pub use frame::{Contact, Frame, STATUSES};
pub use judge::Judge;
pub use scene::{Obstacle, Scene, Surface};
pub use stiction_core::{Event, Evolution, StateKind as State, Status, Touch};
pub use stiction_scene::{InputError, Source};
pub use survey::{LawSurvey, Survey, Violation};
pub use trace::Trace;
