//! The extent of a slip: a driven slip moves, and one that leads nowhere leaves the body where it was.

use super::*;
use crate::real::Fixed;

/// However close it is to where it stops: its drive is not zero to the search.
#[test]
fn what_is_driven_moves() {
    let mut count = 0;
    driven(Demand::Pressed, |case, trammel, seed| {
        let (run, ending) =
            trammel.run(&case.scene, &case.state.contacts(), (0.0, Demand::Pressed));
        if ending != Ending::Stopped {
            return;
        }
        let (mut slide, mut turn) = (run.slide, run.turn);
        for _ in 0..60 {
            (slide, turn) = (0.5 * slide, 0.5 * turn);
            let pivot = case.state.pivot.moved(run.slide - slide, run.turn - turn);
            let state = TwoVertex {
                pivot,
                ..case.state.clone()
            };
            if let Some(near) = Trammel::driven(
                &case.scene,
                (&state.pivot, state.other),
                &case.grip,
                Demand::Pressed,
            ) {
                let (run, _) = near.run(&case.scene, &state.contacts(), (0.0, Demand::Pressed));
                assert!(run.slide != 0.0 || run.turn != 0.0, "{seed} {slide}");
                count += 1;
            }
        }
    });
    assert!(cfg!(miri) || count > 900, "{count}");
}

/// If a slip makes no progress, the body stays to the bit.
#[test]
fn slip_that_leads_nowhere_leaves_the_body_where_it_was() {
    let mut count = 0;
    driven(Demand::AtTheEnd, |case, _, seed| {
        let mut state = case.state.clone();
        for _ in 0..4 {
            let begin = state.clone();
            let moved = state.slip_to_the_end(&case.scene, &case.grip);
            if moved.trigger == Trigger::Undriven {
                assert_eq!(state, begin, "{seed}");
                count += 1;
            }
        }
    });
    assert!(cfg!(miri) || count > 10, "{count}");
}

/// Across almost collinear surfaces the path bends by more than the number type represents; both contacts stay on their surfaces.
#[test]
fn contacts_stay_on_surfaces_that_are_almost_in_line() {
    let number = |x: f64| Fixed::from_si(x as f32, 1.0);
    let real = |x: Fixed| f64::from(x.to_si(1.0));
    let vector = |v: Vec2<Fixed>| Vec2::new(real(v.x), real(v.y));
    let surface = |normal| SurfaceDescription {
        normal,
        offset: -1.0,
        friction_static: 0.5,
        friction_dynamic: 0.3,
        memory: None,
    };
    for exponent in 5..20 {
        let (sin, cos) = libm::sincos(libm::ldexp(1.0, -exponent));
        let scene = Scene::<Fixed, 4, 2>::new(&Description {
            vertices: &[[0.5, 0.0], [0.0, 0.5], [-0.5, 0.0], [0.0, -0.5]],
            start: [0.0; 3],
            weight: 0.0,
            holding_point: None,
            reach: 1.0,
            stiffness_translation: 1.0,
            stiffness_rotation: 0.0,
            surfaces: &[surface([0.0, 1.0]), surface([-sin as f32, -cos as f32])],
            obstacles: &[],
        });
        let scene = scene.expect("a lawful scene");
        let surfaces = [0, 1].map(|surface| scene.surface(surface));
        for along in [0.0, 0.25, -1.0 / 1024.0] {
            let arm = Vec2::new(number(along), number(0.0625));
            for sense in [Fixed::ONE, -Fixed::ONE] {
                let curve = Trammel::<Fixed>::curve(&surfaces, arm, sense);
                for k in 0..20 {
                    let place = curve.at(number(libm::ldexp(1.0, -k)));
                    let (slide, turn) = (real(place.part()), real(place.turn));
                    let (sin, cos) = libm::sincos(turn);
                    let r = vector(arm);
                    let turned = Vec2::new(cos * r.x - sin * r.y, sin * r.x + cos * r.y);
                    let displacement = vector(surfaces[0].tangent) * slide + turned - r;
                    let left = vector(surfaces[1].normal).dot(displacement);
                    let is_far = slide.abs() > 1.0;
                    assert!(is_far || left.abs() < 1e-7, "{exponent} {along} {k} {left}");
                }
            }
        }
    }
}

/// For a body that stands upright between parallel surfaces the gap does not change with a small turn, nor with a slide: the rounding of
/// both does not make it turn.
#[test]
fn upright_between_parallel_surfaces_it_slides_without_a_turn() {
    for (quarter, rounding) in [(-0.25, 0.0), (0.25, 1e-7), (0.25, -1e-7)] {
        let turn = core::f32::consts::TAU * quarter + rounding;
        let rotation = Orientation::new(Angle::from_radians(turn)).rotation();
        let scene = Scene::<f32, 4, 2>::new(&Description {
            vertices: &[[0.5, 0.0], [-0.5, 0.0]],
            start: [0.0; 3],
            weight: 0.0,
            holding_point: None,
            reach: 1.0,
            stiffness_translation: 1.0,
            stiffness_rotation: 0.0,
            surfaces: &[[0.0, 1.0], [0.0, -1.0]].map(|normal| SurfaceDescription {
                normal,
                offset: -0.5,
                friction_static: 0.1,
                friction_dynamic: 0.06,
                memory: None,
            }),
            obstacles: &[],
        });
        let scene = scene.expect("a lawful scene");
        let surfaces = [0, 1].map(|surface| scene.surface(surface));
        let arm = rotation.apply(Vec2::new(-1.0, 0.0));
        for sense in [1.0, -1.0] {
            let curve = Trammel::<f32>::curve(&surfaces, arm, sense);
            let place = curve.at(0.5);
            assert_eq!((place.part(), place.turn), (0.5 * sense, 0.0), "{turn}");
        }
    }
}
