//! One vertex on two surfaces (STATICS 6): pinned like a single vertex; the reaction may lie anywhere in the sum of the
//! two friction cones. Beyond an outer edge of that sum the vertex slides along the surface of that edge.

use super::fixed_pose::FixedPose;
use super::segment::Segment;
use crate::contact::{Pair, Pairs, Reactions};
use crate::geometry::Vec2;
use crate::grip::Grip;
use crate::list::gather;
use crate::load::Load;
use crate::moment::{Downhill, Pinned};
use crate::pivot::Pivot;
use crate::real::Real;
use crate::thresholds::Thresholds;
use crate::verb::{Moved, Trigger};
use crate::work::Work;
use crate::world::World;

/// The memory: the vertex on its first surface, the angle, and the second surface.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Corner<R> {
    pub(crate) pivot: Pivot<R>,
    pub(crate) surface: u8,
    /// mu_s limits the friction, not mu_d.
    pub(crate) stiction: bool,
}

/// An outer edge of the sum of the cones: the contact that it belongs to and its direction of slip, and the inner normal.
struct OuterEdge<R> {
    contact: usize,
    sign: R,
    inner: Vec2<R>,
}

impl<R: Real> Corner<R> {
    pub(crate) fn contacts(&self) -> Pairs {
        let first = self.pivot.contact;
        let second = Pair {
            vertex: first.vertex,
            surface: self.surface,
        };
        gather([first, second])
    }

    /// The edges of the two cones: contact and direction.
    fn cone_edges(&self, scene: &impl World<R>) -> [(usize, Vec2<R>); 4] {
        let edge = |contact: usize, side: R| {
            let index = if contact == 0 {
                self.pivot.contact.surface
            } else {
                self.surface
            };
            let surface = scene.surface(index);
            let edge = surface.friction.edge(self.stiction, side);
            (contact, surface.direction(edge))
        };
        [
            edge(0, R::ONE),
            edge(0, -R::ONE),
            edge(1, R::ONE),
            edge(1, -R::ONE),
        ]
    }

    /// The two outer edges; none if the cones span the whole plane.
    fn outer_edges(&self, scene: &impl World<R>) -> [Option<OuterEdge<R>>; 2] {
        let edges = self.cone_edges(scene);
        [R::ONE, -R::ONE].map(|turn| {
            let outer = edges.iter().find(|(_, direction)| {
                let inner = direction.turned() * turn;
                edges
                    .iter()
                    .all(|(_, other)| inner.dot(*other) >= -R::parallel())
            });
            // The edge with friction along +t is the clockwise one of its cone.
            outer.map(|&(contact, direction)| OuterEdge {
                contact,
                sign: -turn,
                inner: direction.turned() * turn,
            })
        })
    }

    /// Beyond an outer edge the vertex slides along the surface of that edge and leaves the other; if this direction leads into the other
    /// surface, it climbs that one.
    fn slides(&self, scene: &impl World<R>, outer: &OuterEdge<R>) -> Trigger<R> {
        let index = [self.pivot.contact.surface, self.surface];
        let [first, second] = index.map(|s| scene.surface(s));
        let (along, other) = if outer.contact == 0 {
            (first, second)
        } else {
            (second, first)
        };
        let direction = along.tangent * outer.sign;
        let climbs = other.normal.dot(direction) < -R::parallel();
        let (contact, sign) = if climbs {
            let beside = if outer.contact == 0 { 1 } else { 0 };
            (beside, other.tangent.dot(direction).sign())
        } else {
            (outer.contact, outer.sign)
        };
        Trigger::Keep {
            contacts: [contact, contact],
            sliding: Some(sign),
        }
    }

    /// Turns about the corner as the hand moves, to the first of fold, touch, outer edge.
    #[inline(never)]
    pub(crate) fn advance(
        &mut self,
        scene: &impl World<R>,
        from: &Grip<R>,
        to: &Grip<R>,
    ) -> Moved<R> {
        let load = self.pivot.load(scene, from);
        let displacement = from.displacement_to(to);
        let mut segment = Segment::pinned(scene, &load, &displacement, &self.contacts());
        for outer in self.outer_edges(scene).into_iter().flatten() {
            segment.stop_at(
                &load.reaction(outer.inner, &displacement),
                self.slides(scene, &outer),
            );
        }
        segment.turn_with_hand(scene, &mut self.pivot, to)
    }

    /// Turns downhill about the corner to balance, then tests the reaction.
    #[inline(never)]
    pub(crate) fn relax(&mut self, scene: &impl World<R>, grip: &Grip<R>) -> Moved<R> {
        let moment = self.pivot.load(scene, grip).pinned::<Pinned>();
        self.turn_by(scene, grip, &moment.downhill())
    }

    /// The same from a fold of the branch, on in the direction of the sign.
    #[inline(never)]
    pub(crate) fn snap(&mut self, scene: &impl World<R>, grip: &Grip<R>, direction: R) -> Moved<R> {
        let moment = self.pivot.load(scene, grip).pinned::<Pinned>();
        self.turn_by(scene, grip, &moment.over_fold(direction))
    }

    /// Turns the body about the corner by the result of a search downhill, to balance or to the first touch, then tests the reaction.
    fn turn_by(
        &mut self,
        scene: &impl World<R>,
        grip: &Grip<R>,
        downhill: &Downhill<R>,
    ) -> Moved<R> {
        let lasting = self.contacts();
        let mut moved = Segment::<R>::turn_downhill(scene, &mut self.pivot, &lasting, downhill);
        if moved.trigger == Trigger::Balanced {
            moved.trigger = self.test(scene, grip);
        }
        moved
    }

    /// Tests the reaction in balance: inside the outer edges the vertex rests, beyond one it slides along that surface, pulled off both it
    /// is free (STATICS 6).
    fn test(&self, scene: &impl World<R>, grip: &Grip<R>) -> Trigger<R> {
        let load = self.pivot.load(scene, grip);
        let rounding = load.rounding();
        let mut trigger = Trigger::Balanced;
        let mut worst = -rounding;
        for outer in self.outer_edges(scene).into_iter().flatten() {
            let inside = -outer.inner.dot(load.force);
            if inside < worst {
                worst = inside;
                trigger = self.slides(scene, &outer);
            }
        }
        let pulled = [self.pivot.contact.surface, self.surface]
            .into_iter()
            .all(|s| scene.surface(s).normal.dot(load.force) > rounding);
        if pulled { Trigger::Clear } else { trigger }
    }

    fn fixed_pose(&self, scene: &impl World<R>) -> FixedPose<R> {
        FixedPose::new(scene, &self.pivot, (&self.contacts(), self.stiction))
    }

    /// Surfaces press harder than the load pulls by at most 1 over the sine of the angle between an edge of one cone and one of the other.
    /// For half-planes alone the angle of the normals is used.
    pub(crate) fn is_jammed<W: World<R>>(
        &self,
        scene: &W,
        grip: &Grip<R>,
        work: &mut Work,
    ) -> bool {
        let sine = if W::CORNERS {
            let [a, b, c, d] = self.cone_edges(scene).map(|(_, edge)| edge);
            let pairs = [(a, c), (a, d), (b, c), (b, d)];
            (pairs.into_iter()).fold(R::ONE, |least, (one, other)| {
                least.min(one.cross(other).abs())
            })
        } else {
            let [first, second] =
                [self.pivot.contact.surface, self.surface].map(|s| scene.surface(s).normal);
            first.cross(second).abs()
        };
        let narrow = sine * R::limit();
        let size = self.pivot.load(scene, grip).force.length_bound();
        let may_jam = narrow < size;
        if !may_jam {
            return false;
        }
        let fixed_pose = self.fixed_pose(scene);
        let is_jammed = fixed_pose.is_jammed(scene, grip);
        work.spend(fixed_pose.work());
        is_jammed
    }

    pub(crate) fn reactions(&self, scene: &impl World<R>, load: &Load<R>) -> Reactions<R> {
        self.fixed_pose(scene).reactions(scene, load)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Angle, Orientation};
    use crate::real::Fixed;
    use crate::scene::{Description, Scene, SurfaceDescription};

    /// A point on two surfaces whose normals are turned from the upright by these angles, with their mu_s, twice mu_d.
    fn corner<R: Real>(
        si: impl Fn(f64) -> R::Si,
        angles: [f64; 2],
        mu: [f64; 2],
    ) -> (Scene<R, 1, 2>, Corner<R>) {
        let surface = |i: usize| SurfaceDescription {
            normal: [-libm::sin(angles[i]), libm::cos(angles[i])].map(&si),
            offset: si(0.0),
            friction_static: si(mu[i]),
            friction_dynamic: si(mu[i] / 2.0),
            memory: None,
        };
        let scene = Scene::new(&Description {
            vertices: &[[0.0; 2].map(&si)],
            start: [0.0; 3].map(&si),
            weight: si(0.0),
            holding_point: Some([0.0; 2].map(&si)),
            reach: si(0.0),
            stiffness_translation: si(1.0),
            stiffness_rotation: si(1.0),
            surfaces: &[surface(0), surface(1)],
            obstacles: &[],
        });
        let pivot = Pivot {
            contact: Pair::default(),
            foot: R::ZERO,
            orientation: Orientation::new(Angle::default()),
        };
        let corner = Corner {
            pivot,
            surface: 1,
            stiction: true,
        };
        (scene.expect("a sound scene"), corner)
    }

    /// The reaction may have any direction between the outer edges of the two cones, of mu_s or of mu_d, inclusive; if it leaves both
    /// surfaces the vertex is free, otherwise it slides on one of them. The cone of a rough plane may contain both.
    #[test]
    fn vertex_stays_while_the_reaction_is_between_the_outer_edges() {
        let even = [0.3, 1.2, 1.9, -0.7].map(|angle| (angle, [0.5, 0.5]));
        let rough = [
            (0.3, [0.1, 1.5]),
            (0.3, [1.5, 0.1]),
            (-0.4, [0.2, 2.0]),
            (-0.4, [2.0, 0.2]),
        ];
        let both = |case| [true, false].map(|stiction| (case, stiction));
        for ((angle, mu), stiction) in even.into_iter().chain(rough).flat_map(both) {
            let (scene, mut corner) = corner::<f64>(|x| x, [0.0, angle], mu);
            corner.stiction = stiction;
            let dynamic = if stiction { 1.0 } else { 0.5 };
            let [floor, plane] = mu.map(|mu| libm::atan(mu * dynamic));
            let (first, last) = (f64::min(-floor, angle - plane), floor.max(angle + plane));
            for i in -300..=300 {
                // Angles of the reaction from the floor's normal, including both edges.
                let edges = [first, last];
                let turn = match i {
                    -300 | 300 => edges[usize::from(i > 0)],
                    _ => f64::from(i) * core::f64::consts::PI / 300.0,
                };
                let pull = Vec2::new(libm::sin(turn), -libm::cos(turn));
                let grip = Grip {
                    holding_point: Vec2::ZERO,
                    hand: pull,
                    angle: Angle::default(),
                };
                let leaves = |normal: f64| libm::cos(turn - normal) < -1e-12;
                let trigger = corner.test(&scene, &grip);
                if (first..=last).contains(&turn) {
                    assert_eq!(trigger, Trigger::Balanced, "{angle} {turn}");
                } else if leaves(0.0) && leaves(angle) {
                    assert_eq!(trigger, Trigger::Clear, "{angle} {turn}");
                } else {
                    let Trigger::Keep {
                        contacts,
                        sliding: Some(sign),
                    } = trigger
                    else {
                        panic!("{angle} {turn} {trigger:?}");
                    };
                    // In the direction of the hand's pull, but not into the other surface.
                    let [along, other] =
                        [contacts[0], 1 - contacts[0]].map(|i| scene.surface(i as u8));
                    let direction = along.tangent * sign;
                    assert!(direction.dot(pull) > 0.0, "{angle} {turn}");
                    assert!(other.normal.dot(direction) > -1e-12, "{angle} {turn}");
                }
            }
        }
    }

    /// A vertex that is pushed into a narrow wedge of smooth surfaces stays only if their reactions bear the push.
    fn wedge_bears_what_it_holds<R: Real>(si: impl Fn(f64) -> R::Si) -> usize {
        let mut held = 0;
        for (exponent, tilt) in (0..24).flat_map(|k| [0.0, 0.4, 2.0].map(|tilt| (k, tilt))) {
            let narrow = libm::ldexp(1.3, -exponent);
            let angles = [tilt, tilt + core::f64::consts::PI - narrow];
            let (scene, corner) = corner::<R>(&si, angles, [0.0; 2]);
            // Into the wedge, and with a component onto its first surface.
            let [first, second] = [0, 1].map(|surface| scene.surface(surface));
            let into = first.tangent * -second.normal.dot(first.tangent).sign();
            let grip = Grip {
                holding_point: Vec2::ZERO,
                hand: (into - first.normal).over(R::from_int(64)),
                angle: Angle::default(),
            };
            if corner.test(&scene, &grip) != Trigger::Balanced {
                continue;
            }
            let load = corner.pivot.load(&scene, &grip);
            let reactions = corner.reactions(&scene, &load);
            let (mut left, mut most) = (load.force, load.force.length_bound());
            for ([normal, _], surface) in reactions.into_iter().zip([first, second]) {
                left = left + surface.normal * normal;
                most = most.max(normal);
            }
            // Beyond the range of the number type they need not be reported.
            let is_borne = left.length_bound() <= most / R::from_int(1000);
            assert!(is_borne || most >= R::RANGE, "{narrow} {tilt}");
            held += 1;
        }
        held
    }

    #[test]
    fn wedge_bears_what_it_holds_in_every_number_type() {
        assert_eq!(wedge_bears_what_it_holds::<f64>(|x| x), 72);
        assert!(wedge_bears_what_it_holds::<f32>(|x| x as f32) > 60);
        assert!(wedge_bears_what_it_holds::<Fixed>(|x| x as f32) > 60);
    }
}
