//! Bodies among obstacles with corners, in every number type, over whole runs; and the laws that every frame obeys.

extern crate std;

use crate::contact::Pair;
use crate::fixtures::number;
use crate::hand::Hand;
use crate::model::WithObstacles;
use crate::output::Output;
use crate::real::Real;
use crate::scene::{Description, ObstacleDescription, Scene, SurfaceDescription};
use crate::solver::{Evolution, Solver, State};
use std::vec::Vec;

pub(super) type Among<R> = Scene<R, 4, 1, WithObstacles<3, 12>>;

/// A scene; values that are exact in f32 are the same in all number types. Lengths in m, the translational stiffness is
/// 1 N/m.
#[derive(Clone, Debug)]
pub(super) struct Setting {
    pub(super) body: Vec<[f64; 2]>,
    pub(super) start: [f64; 3],
    pub(super) weight: f64,
    pub(super) held_at: [f64; 2],
    /// N·m
    pub(super) stiffness: f64,
    pub(super) obstacles: Vec<Vec<[f64; 2]>>,
    /// mu_s, mu_d
    pub(super) friction: [f64; 2],
}

/// A box about its middle.
pub(super) fn box_of([width, height]: [f64; 2]) -> Vec<[f64; 2]> {
    let (x, y) = (width / 2.0, height / 2.0);
    [[-x, -y], [x, -y], [x, y], [-x, y]].into()
}

/// A block whose top is at the height 0.
pub(super) fn table([from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    [[from, -0.5], [to, -0.5], [to, 0.0], [from, 0.0]].into()
}

/// A post that ends in a point at the height 0.
pub(super) fn post(x: f64) -> Vec<[f64; 2]> {
    [[x - 0.125, -0.5], [x + 0.125, -0.5], [x, 0.0]].into()
}

impl Setting {
    pub(super) fn scene<R: Real>(&self) -> Among<R>
    where
        R::Si: From<f32>,
    {
        let si = |x: f64| R::Si::from(x as f32);
        let points = |list: &[[f64; 2]]| -> Vec<[R::Si; 2]> {
            let point = |p: &[f64; 2]| p.map(si);
            list.iter().map(point).collect()
        };
        let [friction_static, friction_dynamic] = self.friction.map(si);
        let body = points(&self.body);
        let lists: Vec<_> = self.obstacles.iter().map(|list| points(list)).collect();
        let obstacle = |vertices| ObstacleDescription {
            vertices,
            friction_static,
            friction_dynamic,
            memory: None,
        };
        let obstacles: Vec<_> = lists.iter().map(|list| obstacle(list)).collect();
        // Nothing reaches it.
        let surface = SurfaceDescription {
            normal: [si(0.0), si(1.0)],
            offset: si(-8.0),
            friction_static,
            friction_dynamic,
            memory: None,
        };
        let description = Description {
            vertices: &body,
            start: self.start.map(si),
            weight: si(self.weight),
            holding_point: Some(self.held_at.map(si)),
            reach: si(0.0),
            stiffness_translation: si(1.0),
            stiffness_rotation: si(self.stiffness),
            surfaces: &[surface],
            obstacles: &obstacles,
        };
        Scene::new(&description).expect("a sound scene")
    }
}

/// A run and its last answer.
pub(super) struct Run<R: Real> {
    pub(super) solver: Solver<R, 4, 1, WithObstacles<3, 12>>,
    pub(super) state: State<R>,
    pub(super) output: Output<R::Si>,
    pub(super) setting: Setting,
}

impl<R: Real> Run<R>
where
    R::Si: From<f32> + Into<f64>,
{
    pub(super) fn start(setting: &Setting, evolution: Evolution, hand: [f64; 3]) -> Self {
        let solver = Solver::new(setting.scene::<R>(), evolution);
        let (state, output) = solver.start(Self::hand(hand));
        let setting = setting.clone();
        Self {
            solver,
            state,
            output,
            setting,
        }
    }

    fn hand(hand: [f64; 3]) -> Hand<R::Si> {
        let [x, y, phi] = hand.map(|x| R::Si::from(x as f32));
        Hand::new(x, y, phi)
    }

    pub(super) fn step(&mut self, hand: [f64; 3]) {
        self.output = self.solver.step(&mut self.state, Self::hand(hand));
    }

    /// Straight to a pose of the hand in the given number of frames.
    pub(super) fn go(&mut self, [from, to]: [[f64; 3]; 2], frames: u32) {
        for i in 1..=frames {
            let part = f64::from(i) / f64::from(frames);
            let at = |k: usize| from[k] + (to[k] - from[k]) * part;
            self.step([at(0), at(1), at(2)]);
        }
    }

    /// x, y (m), theta (rad).
    pub(super) fn pose(&self) -> [f64; 3] {
        let [x, y] = self.output.position;
        [x.into(), y.into(), self.output.angle.radians().into()]
    }

    pub(super) fn contacts(&self) -> Vec<Pair> {
        let contacts = self.state.contact.contacts();
        contacts.iter().copied().collect()
    }

    /// (x, N, T) of each contact, from left to right.
    pub(super) fn reactions(&self) -> Vec<[f64; 3]> {
        let contacts = self.solver.contacts(&self.state);
        let reaction = |c: &crate::forces::Contact<R::Si>| {
            [c.point[0].into(), c.normal.into(), c.friction.into()]
        };
        let mut list: Vec<[f64; 3]> = contacts.iter().map(reaction).collect();
        list.sort_by(|a, b| a[0].total_cmp(&b[0]));
        list
    }

    /// The residual of forces and moment, about the origin, of a body that is held.
    pub(super) fn unbalanced(&self) -> [f64; 3] {
        let wrench = self.solver.wrench(&self.state);
        let [x, y, theta] = self.pose();
        let (sin, cos) = libm::sincos(theta);
        let place = |p: [f64; 2]| [x + cos * p[0] - sin * p[1], y + sin * p[0] + cos * p[1]];
        let moment_of = |at: [f64; 2], f: [f64; 2]| at[0] * f[1] - at[1] * f[0];
        let hand = place(self.setting.held_at);
        let pull: [f64; 2] = wrench.force.map(Into::into);
        let couple: f64 = wrench.moment.into();
        let weight = [0.0, -self.setting.weight];
        let mut left = [pull[0], pull[1] + weight[1], couple + moment_of(hand, pull)];
        let count = self.setting.body.len() as f64;
        let middle = |k: usize| self.setting.body.iter().map(|v| v[k]).sum::<f64>() / count;
        left[2] += moment_of(place([middle(0), middle(1)]), weight);
        for contact in self.solver.contacts(&self.state).iter() {
            let n: [f64; 2] = contact.direction.map(Into::into);
            let (normal, friction): (f64, f64) = (contact.normal.into(), contact.friction.into());
            let at: [f64; 2] = contact.point.map(Into::into);
            let f = [
                n[0] * normal + n[1] * friction,
                n[1] * normal - n[0] * friction,
            ];
            left[0] += f[0];
            left[1] += f[1];
            left[2] += moment_of(at, f);
        }
        left
    }

    /// The body is in no obstacle, its contacts are closed and on their sides.
    pub(super) fn is_outside(&self, tolerance: f64) -> bool {
        let scene = &self.solver.scene;
        let tolerance = number::<R>(tolerance);
        let placed = self.state.contact.placed(scene);
        let contacts = self.contacts();
        let mut closed = contacts.iter().map(|&pair| {
            placed
                .gap(scene, pair)
                .abs()
                .max(placed.beyond(scene, pair))
                <= tolerance
        });
        closed.all(|is| is) && !placed.is_in_obstacle(scene, tolerance)
    }
}
