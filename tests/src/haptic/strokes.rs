//! The hand's path: minimum-jerk strokes that touch obliquely, press, drag, turn, lift and return. The end of a stroke is chosen
//! by how deep the body would be in a surface if it followed the hand.

use crate::draw::Draw;
use crate::run::between;
use crate::setup::Setup;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The hand turns no further than this from the start (rad).
const TURN: f64 = 1.2;
/// Two surfaces whose normals' cross product is smaller are not pressed simultaneously.
const PARALLEL: f64 = 0.2;
/// The greatest depth to which the hand presses (L).
const DEEPEST: f64 = 0.15;

/// The hand of a scene.
pub(super) struct Hand<'a> {
    draw: Draw,
    setup: &'a Setup,
    /// L (m)
    l: f64,
    /// phi at the start (rad).
    base: f64,
    /// x, y (m), phi (rad): where the hand would be if the body had no weight.
    at: [f64; 3],
    /// The surface that the hand works on, and how deep (m); negative outside it.
    work: (usize, f64),
}

impl<'a> Hand<'a> {
    /// Above the floor at any angle, with the body in the air.
    pub(super) fn above(mut draw: Draw, setup: &'a Setup) -> Self {
        let (l, base) = (setup.size(), draw.between(-FRAC_PI_2, FRAC_PI_2));
        let work = (0, -l * draw.between(0.1, 0.3));
        let mut hand = Self {
            draw,
            setup,
            l,
            base,
            at: [0.0, l, base],
            work,
        };
        hand.at = hand.beside(base, 0.0, -0.1 * l);
        hand
    }
    /// x, y (m), theta (rad) of the body that this hand holds at rest.
    pub(super) fn body(&self) -> [f64; 3] {
        let [x, y, phi] = self.at;
        let point = self.setup.holding_point.unwrap_or_default();
        let [dx, dy] = self.setup.world([0.0, 0.0, phi], point);
        [x - dx, y - dy, phi]
    }
    /// The samples of 3 to 4 s at 1 kHz, rounded to f32.
    pub(super) fn samples(mut self) -> Vec<[f64; 3]> {
        let frames = 3000 + self.draw.below(1001);
        let raised = self.setup.weight / self.setup.stiffness_translation;
        let mut samples = vec![self.at];
        while samples.len() <= frames {
            let (from, to) = (self.at, self.stroke());
            let duration = 60 + self.draw.below(340);
            let way = |i| minimum_jerk(f64::from(i) / duration as f64);
            samples.extend((1..=duration as u32).map(|i| between(from, to, way(i))));
            self.at = to;
        }
        samples.truncate(frames + 1);
        let carried = |[x, y, phi]: [f64; 3]| [x, y + raised, phi].map(|v| f64::from(v as f32));
        samples.into_iter().map(carried).collect()
    }

    /// The end of the next stroke. `rest` is how deep it may go into other surfaces.
    fn stroke(&mut self) -> [f64; 3] {
        let phi = self.at[2];
        let along = self.draw.between(0.05, 0.8) * self.draw.one(&[-1.0, 1.0]) * self.l;
        let rest = self.depth();
        if self.work.1 < 0.0 {
            return self.touch(along, rest);
        }
        let (surface, depth) = self.work;
        match self.draw.below(20) {
            // Continues to drag.
            0..5 => self.beside(phi, along, rest),
            // Presses more or less, in place or while it moves.
            5..8 => {
                self.work = (surface, self.depth());
                let along = along * self.draw.one(&[0.0, 1.0]);
                self.beside(phi, along, rest)
            }
            // Turns.
            8..10 => {
                let phi = self.turned(surface);
                self.beside(phi, 0.3 * along, rest)
            }
            // Moves into a second surface.
            10..13 => {
                let flush = self.flush(surface);
                let phi = self.draw.one(&[phi, flush]);
                self.two_surfaces(phi, rest)
            }
            // Rests.
            13 => self.at,
            // Lifts, straight or obliquely.
            _ => {
                self.work = (surface, -self.l * self.draw.between(0.01, 0.2));
                let along = along * self.draw.one(&[0.0, 0.3, 1.0]);
                self.beside(phi, along, depth)
            }
        }
    }
    /// From the air onto one surface or two.
    fn touch(&mut self, along: f64, rest: f64) -> [f64; 3] {
        let surface = self.draw.below(self.setup.surfaces.len());
        self.work = (surface, self.depth());
        let phi = self.turned(surface);
        match self.draw.below(3) {
            0 => self.two_surfaces(phi, rest),
            _ => self.beside(phi, along, rest),
        }
    }
    /// How deep to press (m): 0.003 to 0.15 L.
    fn depth(&mut self) -> f64 {
        self.l * DEEPEST * self.draw.power(-1.7, 0.0)
    }
    /// Flush with a surface, or at any angle.
    fn turned(&mut self, surface: usize) -> f64 {
        match self.draw.below(5) {
            0..3 => self.flush(surface),
            _ => {
                let turn = self.at[2] - self.base + self.draw.between(-0.7, 0.7);
                self.base + turn.clamp(-TURN, TURN)
            }
        }
    }
    /// The angle nearest to that of the start at which a side of the body lies flush on a surface, with the small error of
    /// a human hand.
    fn flush(&mut self, surface: usize) -> f64 {
        let [nx, ny] = self.setup.surfaces[surface].normal;
        let vertices = &self.setup.vertices;
        let turn = |(i, a): (usize, &[f64; 2])| {
            let b = vertices[(i + 1) % vertices.len()];
            // The side's outer normal, relative to the surface's normal.
            let outer = (b[1] - a[1]).atan2(b[0] - a[0]) - FRAC_PI_2;
            let turn = ny.atan2(nx) + PI - outer - self.base;
            turn - TAU * (turn / TAU).round()
        };
        let turns = vertices.iter().enumerate().map(turn);
        let nearest = turns.fold(f64::MAX, |a, b| if b.abs() < a.abs() { b } else { a });
        self.base + nearest.clamp(-TURN, TURN) + self.draw.one(&[0.0, 0.0, 0.004, -0.01])
    }

    /// A displacement `along` the surface of work, at the depth of the work; no deeper than `rest` in other surfaces.
    fn beside(&self, phi: f64, along: f64, rest: f64) -> [f64; 3] {
        let (surface, depth) = self.work;
        let [nx, ny] = self.setup.surfaces[surface].normal;
        let there = [self.at[0] + along * ny, self.at[1] - along * nx];
        let out = self.missing(surface, phi, there) - depth;
        let mut there = [there[0] + out * nx, there[1] + out * ny];
        for other in 0..self.setup.surfaces.len() {
            let missing = self.missing(other, phi, there) - rest;
            if missing > 0.0 {
                there = self.shifted(there, other, missing).unwrap_or(there);
            }
        }
        self.relieved(phi, there)
    }
    /// Into the surface of work, and into another one by `rest`.
    fn two_surfaces(&mut self, phi: f64, rest: f64) -> [f64; 3] {
        let [x, y, _] = self.beside(phi, 0.0, rest);
        let other = self.draw.below(self.setup.surfaces.len());
        let missing = self.missing(other, phi, [x, y]) - rest;
        let there = self.shifted([x, y], other, missing).unwrap_or([x, y]);
        self.relieved(phi, there)
    }
    /// Moves out of surfaces into which nobody would press so deep.
    fn relieved(&self, phi: f64, [mut x, mut y]: [f64; 2]) -> [f64; 3] {
        for (i, surface) in self.setup.surfaces.iter().enumerate() {
            let beyond = (self.missing(i, phi, [x, y]) - DEEPEST * self.l).max(0.0);
            x += beyond * surface.normal[0];
            y += beyond * surface.normal[1];
        }
        [x, y, phi]
    }
    /// The distance by which the hand would have to move out of a surface for the body to just touch it (m).
    fn missing(&self, surface: usize, phi: f64, [x, y]: [f64; 2]) -> f64 {
        let surface = &self.setup.surfaces[surface];
        let [nx, ny] = surface.normal;
        let [gx, gy] = self.setup.holding_point.unwrap_or_default();
        let height = |v: &[f64; 2]| {
            let [dx, dy] = (self.setup).world([x, y, phi], [v[0] - gx, v[1] - gy]);
            nx * dx + ny * dy
        };
        let lowest = (self.setup.vertices.iter().map(height)).fold(f64::MAX, f64::min);
        surface.offset - lowest
    }
    /// Shifted along the surface of work until it is `way` farther from another one; `None` if they are parallel.
    fn shifted(&self, [x, y]: [f64; 2], other: usize, way: f64) -> Option<[f64; 2]> {
        let [nx, ny] = self.setup.surfaces[self.work.0].normal;
        let [ox, oy] = self.setup.surfaces[other].normal;
        let gain = ox * ny - oy * nx;
        let along = way / gain;
        (gain.abs() > PARALLEL).then_some([x + along * ny, y - along * nx])
    }
}

/// The fraction of a straight path that a hand has covered after a fraction of the time (Flash and Hogan 1985).
fn minimum_jerk(u: f64) -> f64 {
    u * u * u * (10.0 + u * (6.0 * u - 15.0))
}
