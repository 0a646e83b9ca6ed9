//! Nothing holds the angle of a body, with k_theta = 0 and no weight (R34): a vertex that is the holding point, and one
//! whose lever comes to lie in the friction cone.

use stiction_core::{Evolution, Status};
use stiction_tests::run::RunOf;
use stiction_tests::{Number, Run, Setup, test_each};

test_each!(
    cases::vertex_that_is_the_holding_point_is_a_point,
    cases::lever_bears_on_the_edge_of_the_cone,
    cases::lever_in_the_cone_sticks,
    cases::lever_that_touches_in_the_cone_sticks,
    cases::foot_that_bears_nothing_goes_to_and_fro,
    cases::rod_held_at_its_centroid_but_for_rounding_keeps_its_angle,
    cases::rod_held_at_its_centroid_slips_from_under_the_hand,
    cases::without_friction_the_lever_bears_upright,
);

mod cases {
    use super::*;

    const D: f64 = 0.3;

    /// A point at the end of a lever along the surface, which points along ±x.
    fn lever(way: f64, mu: f64) -> Setup {
        Setup::point()
            .held_at([way * D, 0.0])
            .springs(1.0, 0.0)
            .floor([mu, mu])
    }

    /// Pressed, dragged back and forth, lifted: the same as with any rotational stiffness.
    pub(super) fn vertex_that_is_the_holding_point_is_a_point<R: Number>(evolution: Evolution) {
        const WAY: [[f64; 2]; 6] = [
            [0.0, -0.01],
            [0.2, -0.01],
            [0.1, -0.05],
            [-0.2, -0.02],
            [-0.2, 0.1],
            [0.3, -0.1],
        ];
        for friction in [[0.5, 0.3], [0.3, 0.3], [0.0, 0.0]] {
            let run = |stiffness| {
                let setup = Setup::point().springs(1.0, stiffness).floor(friction);
                Run::<R>::start(&setup, evolution, [0.0; 3])
            };
            let (mut free, mut firm) = (run(0.0), run(1.0));
            for [x, y] in WAY {
                let pairs = free.lead([x, y, 0.0], 37);
                let pairs = pairs.into_iter().zip(firm.lead([x, y, 0.0], 37));
                for (free, firm) in pairs {
                    assert_eq!(free.status, Status::Ok, "{free:?}");
                    assert_eq!((free.state, free.slips), (firm.state, firm.slips));
                    R::near("x", free.pose[0], firm.pose[0]);
                    R::near("y", free.pose[1], firm.pose[1]);
                    R::near("N", free.normal(), firm.normal());
                    R::near("T", free.friction(), firm.friction());
                }
            }
        }
    }

    /// The hand moves along and down: nothing bears a load until the lever reaches the edge of the cone. From then on the lever stays
    /// there and the foot slides.
    pub(super) fn lever_bears_on_the_edge_of_the_cone<R: Number>(evolution: Evolution) {
        for (way, mu) in [(1.0, 0.3), (-1.0, 0.3), (1.0, 1.0), (-1.0, 0.0)] {
            let mut run = Run::<R>::start(&lever(way, mu), evolution, [way * D, 0.0, 0.0]);
            let [cos, sin] = [1.0, mu].map(|x| x / f64::hypot(1.0, mu));
            for frame in run.lead([way * (D + 1.0), -0.6, 0.0], 67) {
                let [x, depth] = [frame.hand[0], -frame.hand[1]];
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                let [contact] = frame.contacts[..] else {
                    panic!("one contact: {frame:?}");
                };
                let normal = (depth - D * cos).max(0.0);
                R::near("N", contact.normal, normal);
                R::near("T", contact.friction, -way * mu * normal);
                let along = if normal > 0.0 {
                    D * sin + mu * normal
                } else {
                    (D * D - depth * depth).sqrt()
                };
                R::near("foot", contact.point[0], x - way * along);
            }
        }
    }

    /// The hand moves straight down: when the lever enters the cone, the foot stays, and the lever follows the hand.
    pub(super) fn lever_in_the_cone_sticks<R: Number>(evolution: Evolution) {
        const MU: f64 = 0.5;
        for way in [1.0, -1.0] {
            let mut run = Run::<R>::start(&lever(way, MU), evolution, [way * D, 0.0, 0.0]);
            let [cos, sin] = [1.0, MU].map(|x| x / f64::hypot(1.0, MU));
            for frame in run.lead([way * D, -0.6, 0.0], 60) {
                let depth = -frame.hand[1];
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                let along = D * sin;
                let stretch = (1.0 - D / along.hypot(depth)).max(0.0);
                let bears = depth > D * cos;
                let force = if bears { stretch } else { 0.0 };
                R::near("N", frame.normal(), force * depth);
                R::near("T", frame.friction(), -way * force * along);
                if bears {
                    let foot = frame.contacts[0].point[0];
                    R::near("foot", foot, way * (D - along));
                }
            }
        }
    }

    /// The foot touches with the lever inside the cone: pressed further, it stays.
    pub(super) fn lever_that_touches_in_the_cone_sticks<R: Number>(evolution: Evolution) {
        const MU: f64 = 0.5;
        for way in [1.0, -1.0] {
            // The lever points down and is then tilted by 0.2 rad.
            let [along, down] = [D * 0.2_f64.sin(), D * 0.2_f64.cos()];
            let setup = lever(1.0, MU).at([0.0, 0.1, way * 0.2 - std::f64::consts::FRAC_PI_2]);
            let hand = |x: f64, depth: f64| [way * (along + x), 0.1 - down - depth, 0.0];
            let mut run = Run::<R>::start(&setup, evolution, hand(0.0, 0.0));
            for frame in run.lead(hand(0.06, 0.3), 37) {
                let [x, depth] = [frame.hand[0], -frame.hand[1]];
                let Some(contact) = frame.contacts.first() else {
                    continue;
                };
                let foot = contact.point[0];
                R::near("foot", foot, way * 0.02);
                let force = 1.0 - D / (x - foot).hypot(depth);
                R::near("N", contact.normal, force * depth);
                R::near("T", contact.friction, -force * (x - foot));
            }
            assert!(run.frame.normal() > 0.1, "{:?}", run.frame);
        }
    }

    /// A foot that bears no load is where the hand alone places it, in whichever direction the hand moves.
    pub(super) fn foot_that_bears_nothing_goes_to_and_fro<R: Number>(evolution: Evolution) {
        for way in [1.0, -1.0] {
            let mut run = Run::<R>::start(&lever(way, 0.5), evolution, [way * D, 0.0, 0.0]);
            run.lead([way * 0.4, -0.1, 0.0], 13);
            for [x, y] in [[0.7, -0.11], [0.2, -0.12], [0.25, -0.13], [-1.0, -0.14]] {
                for frame in run.lead([way * x, y, 0.0], 7) {
                    assert_eq!(frame.status, Status::Ok, "{frame:?}");
                    R::near("the pull", frame.wrench[0].hypot(frame.wrench[1]), 0.0);
                    let Some(contact) = frame.contacts.first() else {
                        // A jump of the hand ends where the vertex bears no load, and leaves it there.
                        assert_eq!(evolution, Evolution::Frame, "{frame:?}");
                        continue;
                    };
                    let across = (D * D - frame.hand[1].powi(2)).sqrt();
                    let foot = frame.hand[0] - way * across;
                    R::near("foot", contact.point[0], foot);
                }
            }
        }
    }

    /// A rod that stands on a floor, held at its middle, under a weight that would lower the hand just to the floor: at the first pull it
    /// swings round. Where it comes to rest, friction is in its cone, and it stays so along the hand's path from there.
    pub(super) fn rod_held_at_its_centroid_slips_from_under_the_hand<R: Number>(
        evolution: Evolution,
    ) {
        let setup = Setup::new(&[[0.5, 0.0], [-0.5, 0.0]])
            .springs(1.0, 0.0)
            .weighing(0.5)
            .at([0.0, 0.0, -std::f64::consts::FRAC_PI_2])
            .surface([0.0, 1.0], -0.5, [0.1, 0.03]);
        let mut run = Run::<R>::start(&setup, evolution, [0.0; 3]);
        let mut frames = vec![run.frame.clone()];
        frames.extend(run.lead([-0.2, 0.03, 0.0], 20));
        for frame in frames.iter().filter(|frame| frame.status == Status::Ok) {
            for contact in &frame.contacts {
                let slack = 0.1 * contact.normal - contact.friction.abs();
                assert!(slack > -R::ANALYTIC, "{} {frame:?}", R::NAME);
            }
        }
    }

    /// Where its centroid is within rounding of the hand, no weight turns a rod: it is not known to which side that would be.
    pub(super) fn rod_held_at_its_centroid_but_for_rounding_keeps_its_angle<R: Number>(
        evolution: Evolution,
    ) {
        for aside in [0.0, 1e-17, -1e-17] {
            let setup = Setup::new(&[[0.5, 0.0], [-0.5, 0.0]])
                .held_at([0.0, aside])
                .springs(1.0, 0.0)
                .weighing(0.5)
                .at([0.0, 1.0, 0.4])
                .surface([0.0, 1.0], -1.0, [0.1, 0.03]);
            let mut run = Run::<R>::start(&setup, evolution, [0.0, 1.0, 0.0]);
            for frame in run.lead([0.3, 1.5, 0.0], 7) {
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                R::near("theta", frame.pose[2], 0.4);
                R::near("y", frame.pose[1], frame.hand[1] - 0.5);
            }
        }
    }

    /// A gliding foot, in the model without friction: it is below the hand once the hand is deeper than the lever is long.
    pub(super) fn without_friction_the_lever_bears_upright<R: Number>(evolution: Evolution) {
        let at = [D, 0.0, 0.0];
        let mut run = RunOf::<R, 1, 1, 0>::start(&lever(1.0, 0.0), evolution, at);
        for (hand, frames) in [
            ([1.0, -0.6, 0.0], 67),
            ([1.0, 0.6, 0.0], 1),
            ([0.0, -0.6, 0.0], 1),
        ] {
            for frame in run.lead(hand, frames) {
                let depth = -frame.hand[1];
                assert_eq!(frame.status, Status::Ok, "{frame:?}");
                let normal = if depth < 0.0 {
                    0.0
                } else {
                    (depth - D).max(0.0)
                };
                R::near("N", frame.normal(), normal);
                if normal > 0.0 {
                    R::near("foot", frame.contacts[0].point[0], frame.hand[0]);
                }
            }
        }
    }
}

/// A point that is held at itself up to a rounding error swings round at the first pull: it slides when that pull is outside the cone.
#[test]
fn point_held_at_itself_is_pulled_out_of_its_cone() {
    let mut setup = Setup::new(&[[0.5, 0.0]])
        .at([0.0, 0.0, -std::f64::consts::PI])
        .held_at([0.5, 0.0])
        .springs(1.0, 0.0);
    setup.surfaces = vec![stiction_core::SurfaceDescription {
        normal: [6.123_233_995_736_766e-17, 1.0],
        offset: -9.184_850_993_605_148e-17,
        friction_static: 0.1,
        friction_dynamic: 0.06,
        memory: None,
    }];
    let turn = -std::f64::consts::PI;
    let hands = [
        [-0.5, -6.123_233_995_736_766e-17, turn],
        [
            -0.492_137_876_682_630_87,
            -0.025,
            turn + std::f64::consts::PI / 12.0,
        ],
    ];
    let frames = stiction_tests::run::run::<f64>(&setup, Evolution::Path, &hands);
    stiction_tests::laws::assert_lawful_run::<f64>(&setup, Evolution::Path, &frames);
}
