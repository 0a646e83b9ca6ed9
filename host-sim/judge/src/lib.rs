//! Whether a trace obeys the laws of statics and friction, from nothing but the scene and the trace, ours or another program's.
//! It shares no code with the solver and takes nothing from it but what is printed. Everything in f64, SI units, world frame.
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
//! [`law`] has the name and the statement of every law, [`Bounds`] what is allowed. STATICS is `core/STATICS.md`.
//!
//! # Events
//!
//! * Contacts come with `touch`, `land` and `jam` and go with `lift` and `tip`, with no other event, and not without. All events of a frame,
//!   in their order, lead from the state of the frame before to that of this one. Among obstacles a slip or slide passes contacts
//!   on without a word, and so does what comes to lie flat; their number stays.
//! * `slips` and `events` tell of the same slips. Slips and nothing else, of a vertex or an edge, are as many as lead from the old place
//!   to the new one, each from where static friction gives way to the first place where |T| = mu_d N.
//! * A body to which something is told to have happened is not where it was, to 8 roundings, unless it is left out of balance; nor are
//!   the contacts of a slip.
//! * The angle of a body that turns about a contact, that slides on one, or that hangs in the air goes on along its branch, and `snap` is
//!   told where the branch folds and nowhere else.
//! * A slide begins at mu_d N: what bore more slips first.
//!
//! # Statuses
//!
//! A status excuses what its frame bears out. `held-last` and `saturated` repeat the record before, but for the time; `event-limit` has
//! 100 slips or a full list of events, and is judged as any other frame; `behind` tells what is left. `iteration-limit` and `twist`
//! excuse nothing. `ambiguous` is a body of several contacts (or one whose motions follow one another until the list of events is full,
//! or whose contacts open and close four times) that no reactions hold and that has no motion which the load drives and no contact
//! hinders. `jammed` needs several contacts in more than
//! one line, and reactions that bear the load and are beyond half the limit. Out of balance nothing moves, but that a
//! jammed body may turn about a corner.
//!
//! # Sticking
//!
//! A contact that sticks stays to 8 roundings of the farthest coordinate where it came to, over all frames until something happens: a
//! creep counts by its sum.
//!
//! # Slides
//!
//! A trace may tell of its contacts whether they slide with the hand (`sliding`: -1, 0, 1). Then, and only then,
//!
//! * T = -s mu_d N of a contact that slides along s t, as exactly as at the end of a slip. So its foot is where the law of the slide
//!   puts it, and it goes forward: from its farthest place it goes back by no more than a contact that sticks may move. Where the
//!   hand's way would lead it back it has stopped.
//! * Contacts that slide together do so with the signs of one motion of the body: both vertices of an edge the same way, two on two
//!   surfaces as the twist has it that keeps both there. A velocity that rounding may have turned fits any sign. A vertex in a
//!   corner does not slide, nor do contacts that leave the body no motion.
//! * `slide` and `stop` are reported, but where nothing touches any more. The last of them fits the end of the frame, and a `stop`
//!   that comes first the frame before.
//! * On one surface a slide does not pass N* = k_h D_c / (mu_s - mu_d) from below: it sticks there (path evolution).
//! * Contacts stick where they say so, with mu_s = mu_d, too; but for those without friction, or without force, whose body turns
//!   out of the way.
//! * Sticking is bounded by mu_s. Whether a body has stiction, or sticks up to mu_d alone, a trace does not tell.
//!
//! # What could have held
//!
//! Two vertices that stick keep the body where it is as long as reactions within friction bear the load. All loads that they bear are
//! a convex cone, and the hand goes straight: if the load is in it where the hand was, and where it is, then so it is between, and
//! the body stays. It is unlawful if it does not, unless the hand alone opens all gaps on its way (STATICS 5). Loads count as borne
//! only with reactions of at most 128 k_h L, twice of what is borne without a word, and together with all that differ from them by
//! 64 roundings of these reactions and by the part of their size that the bound on slips allows. The friction is mu_s, but mu_d in a
//! trace that tells slides, as there may be no stiction; and there is if no reactions within mu_d bear the load of the frame before.
//!
//! A body is `jammed` if the load asks for N beyond 64 k_h L. It is not where neither friction, mu_d nor mu_s, asks for that: reactions of
//! half of it bear the load, or none do, however large, as the load drives a twist that opens all contacts. In a trace that tells
//! slides it is not `ok` if every sum within mu_s asks for more than 17/16 of it, which a twist proves.
//!
//! # Obstacles (STATICS 12)
//!
//! A contact is a vertex of the body on a half-plane, or on a side of an obstacle, or a corner of an obstacle on a side of the body,
//! whose normal turns with it ([`Touch`]). Its point, normal and friction are all that balance, slips, slides and what holds
//! know of it, so they are judged as among half-planes: a corner that sticks keeps its place on the body, one that slides goes
//! forward along it, and a slip of it ends where |T| = mu_d N in balance. Two contacts in one line are an edge, whatever their
//! kinds; of two frictions that differ each bears by its share of N. Besides, among obstacles alone:
//!
//! * Body and obstacle are apart along some axis, to what holds for half-planes.
//! * A contact is between the ends of its side (coplanar sides of equal friction that join are one), its side faces what is next to the
//!   vertex or corner, and two contacts with one obstacle are not at one place. A told direction is the normal.
//! * What touches to 8 roundings in two frames running is a contact, unless it has opened meanwhile; but for what is at the end of a
//!   side, between two contacts in one line, at the place of a contact with the same obstacle, or at a corner that something covers.
//! * Without an event contacts stay, or slide and are passed on: what comes is next to what went, on the body and on the obstacle, no
//!   farther than the body has gone.
//! * Nothing goes through a side where its way is known: of a body in the air, with nothing told, it is that of the hand; of
//!   one that sticks on a single contact, a turn about it. A single contact that dynamic friction holds all along the hand's way is
//!   not left, whatever slips, slides and lifts are reported.
//!
//! # What is not judged
//!
//! * Events that undo each other within a frame, as `touch` and `lift` of one contact, and slips, slides and snaps beside other events of
//!   their frame, and how many there were.
//! * `snap` of two contacts that slide, or of one that slides on a corner; `snap` of a slide where nothing holds the angle.
//! * What happens at the very frame, within the rounding: it may be told with this frame or with the next one. So may a slip that is
//!   shorter than what forces are known to.
//! * The length of a slip to better than the place where static friction gives way, which is uncertain where it does so gradually.
//! * What the hand did, where its path is not given: a frame that repeats the one before with `held-last` and the hand with it.
//! * Which one of two contacts came that are next to each other on an obstacle, where a third one was passed on in the same frame.
//! * Of a frame whose list of events is full (16): what came after.
//! * Where a frame with events goes between two balances: a wrong branch of the angle in balance passes, but for a single slip of a
//!   vertex, which must continue the branch of the frame before.
//! * Among obstacles, which way a body went in a frame with a touch, or with a slip or slide that may have led past the end of a side:
//!   it may be on the other side of a wall. Nor where a body that slides or is held by two contacts went. What is passed through and
//!   back within a 64th of a way. Between the pose at the start and the first record.
//! * Which of the pairs at one place is told, and which one a slide is passed on to, of those that are next to it; whether a vertex
//!   exactly at a corner is a contact. Slips of a flat contact whose ends changed.
//! * When a contact should have given way or come to be: that a contact is in its cone, and no vertex inside a surface, is all that
//!   is asked of half-planes. When it should have opened, of a single vertex, a corner, or contacts that slide; nor where a slip would explain it.
//! * Where slips of contacts with mu_s = mu_d are, in a trace that does not tell slides: they slide continuously, and nothing marks
//!   their ends.
//! * Of a frame with a single slip and nothing else: a slip of more than two contacts, one that is no longer than rounding, and
//!   of two vertices on two surfaces, whether its end is the first one on the way, and whether both press there. In a trace that
//!   tells slides it may begin at mu_d N instead, but for one of an edge, or one of a vertex that slides on. Where contacts slide
//!   on from it, its end.
//! * Of a frame with more slips, or slips among other events: all but the last one; that one too where the state is not a
//!   vertex or an edge, where it is not the last event, or where a contact opened before it (the slip may then end out of
//!   balance, and the body turns after it); and which way it went.
//! * Whether a slip should have ended in a slide, and a slide have begun where it did: that asks for the body's stiction. Slides of
//!   two contacts that should have stuck by the length of the slip that is due. D_c of a point, unless the scene gives it.
//! * `slide` and `stop` in frames that are not `ok`, or have a contact without friction or force; one foot of two that turns back.
//! * Of a `jammed` body: its reactions, and its wrench. Of one that is `behind`: all that depends on the hand, in that frame and
//!   the next one, and how far it is.
//! * A body that no hand holds has no balance: it is asked to stay.
//! * Rows of CSV that say that there were more than four contacts: springs, geometry and the contacts that are there.

mod bearing;
mod body;
mod brace;
mod error;
mod events;
mod finding;
mod frame;
mod hold;
mod judge;
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
pub use error::InputError;
pub use finding::{Bounds, Finding, law};
pub use frame::{Contact, Event, Evolution, Frame, State, Status};
pub use judge::Judge;
pub use scene::{Obstacle, Scene, Surface};
pub use survey::{LawSurvey, Survey, Violation};
pub use touch::Touch;
pub use trace::Trace;
