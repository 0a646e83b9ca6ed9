//! The moments worth a snapshot: the ends of the run, the first frame of every other state, and otherwise those that look most different
//! from all others.

use stiction_core::StateKind;
use stiction_live::drawing::{Window, placed};
use stiction_live::record::{ContactRecord, Frame, Run};

/// What two snapshots differ by at least, in parts of the body's size: less is hardly seen.
const DIFFERENCE: f64 = 0.1;
/// Length of the largest force's bar in a snapshot, in parts of the body's size.
const BAR: f64 = 0.45;
/// A run over more than this, in sizes of the body, is shown by pictures that follow the body: its place shows in what is around it, of
/// which this part counts.
const FOLLOWED: f64 = 1.2;
const AROUND: f64 = 0.3;
/// Number of frames that are compared, spread evenly over the run.
const MOST: usize = 4000;

/// The frames nearest to some times [s], in their order.
pub(super) fn nearest<'a>(frames: &'a [Frame], at: &[f64]) -> impl Iterator<Item = &'a Frame> {
    at.iter().filter_map(|t| {
        let apart = |frame: &&Frame| (frame.t - t).abs();
        frames.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))
    })
}

/// The indices of at most `count` frames, in order of time.
pub(super) fn choose(run: &Run, count: usize) -> Vec<usize> {
    let frames = &run.frames;
    let looks = Looks::of(run);
    let ends = [frames.len().saturating_sub(1), 0];
    let all: Vec<usize> = (0..frames.len()).collect();
    let mut chosen: Vec<usize> = Vec::new();
    looks.add(&mut chosen, &ends, count, 0.0);
    let seen: Vec<StateKind> = chosen.iter().map(|&index| frames[index].state).collect();
    let first = |state: &StateKind| frames.iter().position(|frame| frame.state == *state);
    let states = StateKind::ALL.iter().filter(|state| !seen.contains(state));
    let states: Vec<usize> = states.filter_map(first).collect();
    looks.add(&mut chosen, &states, count, 0.0);
    looks.add(&mut chosen, &all, count, DIFFERENCE);
    chosen.sort_unstable();
    chosen
}

/// How frames look.
struct Looks<'a> {
    run: &'a Run,
    /// Size of the body [m], and the largest force [N].
    size: f64,
    force: f64,
    /// The part of the body's place that counts.
    place: f64,
}

impl<'a> Looks<'a> {
    fn of(run: &'a Run) -> Self {
        let corners = run.scene.vertices.iter();
        let size = corners.fold(0.0, |size: f64, [x, y]| size.max(2.0 * x.hypot(*y)));
        let springs = run
            .frames
            .iter()
            .map(|frame| frame.wrench[0].hypot(frame.wrench[1]));
        let force = springs.fold(0.0, f64::max);
        let places = run
            .frames
            .iter()
            .map(|frame| (frame.pose[0], frame.pose[1]));
        let range = Window::around(places).map_or(0.0, |all| all.width().max(all.height()));
        let or_one = |value: f64| if value > 0.0 { value } else { 1.0 };
        Self {
            run,
            size: or_one(size),
            force: or_one(force),
            place: if range > FOLLOWED * size { AROUND } else { 1.0 },
        }
    }

    /// Where body and hand are, and how long the bars of the forces of contacts and hand, in sizes of the body.
    fn look(&self, index: usize) -> Vec<f64> {
        let frame = &self.run.frames[index];
        let hand = (frame.hand[0], frame.hand[1]);
        let [x0, y0, _] = frame.pose;
        let less = 1.0 - self.place;
        let places = placed(&self.run.scene.vertices, frame.pose);
        let places = places.into_iter().chain([hand]);
        let places = places.map(|(x, y)| (x - less * x0, y - less * y0));
        let sum = |force: fn(&ContactRecord) -> f64| frame.contacts.iter().map(force).sum::<f64>();
        let forces = [
            sum(|contact| contact.normal),
            sum(|contact| contact.friction),
            frame.wrench[0],
            frame.wrench[1],
        ];
        places
            .flat_map(|(x, y)| [x / self.size, y / self.size])
            .chain(forces.map(|force| BAR * force / self.force))
            .collect()
    }

    /// Adds candidates, the most different from those chosen first, until there are `count` or none differs by at least `least`.
    fn add(&self, chosen: &mut Vec<usize>, candidates: &[usize], count: usize, least: f64) {
        let spread = candidates.len().div_ceil(MOST).max(1);
        let candidates: Vec<usize> = candidates.iter().copied().step_by(spread).collect();
        let looks: Vec<Vec<f64>> = candidates.iter().map(|&index| self.look(index)).collect();
        let difference = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let mut apart = vec![f64::INFINITY; candidates.len()];
        let mut compared = 0;
        while chosen.len() < count {
            for &other in &chosen[compared..] {
                let look = self.look(other);
                for (apart, candidate) in apart.iter_mut().zip(&looks) {
                    *apart = apart.min(difference(&look, candidate));
                }
            }
            compared = chosen.len();
            let free = candidates.iter().zip(&apart);
            let free = free.filter(|(index, _)| !chosen.contains(index));
            match free.max_by(|a, b| a.1.total_cmp(b.1)) {
                Some((index, apart)) if *apart >= least => chosen.push(*index),
                _ => return,
            }
        }
    }
}
