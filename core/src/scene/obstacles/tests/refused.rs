//! Every parameter of obstacles that is out of its range is refused by its name, with its value and what is allowed.

use super::*;
use crate::Frictionless;
use std::string::ToString;

/// A table and a thin wall, the second one changed.
fn changed(change: impl FnOnce(&mut Setup)) -> Setup {
    let wall = shape(&[[2.0, 0.0], [2.0, 1.0]]);
    let mut setup = Setup::of(&[block([-1.0, -1.0], [2.0, 1.0]), wall]);
    change(&mut setup);
    setup
}

#[track_caller]
fn refused<R: Real<Si: SiFloat>>(setup: &Setup, (parameter, text): (Parameter, &str)) {
    let error = setup.scene::<R, 4, 2, WithObstacles<6, 24>>();
    let error = error.map(|_| ()).expect_err(text);
    assert_eq!(error.parameter, parameter);
    let wide = SceneError {
        parameter,
        value: error.value.widen(),
        allowed: error.allowed,
    };
    // A number that f32 does not represent has other digits.
    let exact =
        wide.value == wide.value as f32 as f64 || error.value.bits() == wide.value.to_bits();
    let message = wide.to_string();
    let shown = if exact {
        message.clone()
    } else {
        text.to_string()
    };
    assert!(shown.starts_with(text), "{message}");
    assert!(message.ends_with(error.allowed));
}

#[track_caller]
fn refused_by_all(parameter: Parameter, text: &str, change: impl FnOnce(&mut Setup)) {
    let (setup, expected) = (changed(change), (parameter, text));
    in_all_numbers!(refused, &setup, expected);
}

#[test]
fn sound_world_is_accepted() {
    fn accepted<R: Real<Si: SiFloat>>() {
        for pin in [false, true] {
            let setup = changed(|s| {
                if pin {
                    s.shapes[1].vertices.pop();
                }
            });
            let scene = setup.scene::<R, 4, 2, WithObstacles<2, 6>>();
            let scene = scene.expect("a sound world");
            assert_eq!(scene.firsts(), [0, 4]);
            assert_eq!(scene.corners().len(), if pin { 5 } else { 6 });
        }
    }
    in_all_numbers!(accepted);
}

#[test]
fn numbers_of_obstacles_and_corners() {
    let pins = |n: usize| (0..n).map(|i| shape(&[[i as f64, 0.0]])).collect();
    let text = "number of obstacles is 7.0, allowed: 0 to the capacity of the solver";
    refused_by_all(Parameter::ObstacleCount, text, |s| s.shapes = pins(7));
    let text = "number of corners of obstacle 1 is 0.0, allowed: 1 or more";
    refused_by_all(Parameter::Corners(1), text, |s| {
        s.shapes[1].vertices.clear()
    });
    let text =
        "number of corners of all obstacles is 28.0, allowed: 0 to the capacity of the solver, and";
    let blocks = |s: &mut Setup| {
        s.shapes = (0..6).map(|i| block([i as f64, 0.0], [1.0, 1.0])).collect();
        s.shapes[1].vertices = (0..8).map(|i| (-f64::from(i)).sin_cos().into()).collect();
    };
    refused_by_all(Parameter::CornerCount, text, blocks);
}

/// Half-planes and corners share 255 indices.
#[test]
fn corners_have_indices_beside_half_planes() {
    let setup = |planes: usize, pins: usize| {
        changed(|s| {
            s.planes = vec![([0.0, 1.0], -5.0); planes];
            s.shapes = (0..pins)
                .map(|i| shape(&[[0.05 * i as f64, 0.0]]))
                .collect();
        })
    };
    type Many = WithObstacles<300, 300>;
    for (planes, pins) in [(0, 255), (1, 254), (2, 253)] {
        let scene = setup(planes, pins).scene::<f64, 2, 2, Many>().expect("255");
        let index = u8::try_from(planes).expect("few");
        assert_eq!(scene.corners().last().map(|c| c.line), Some(254));
        assert_eq!(scene.corners().first().map(|c| c.line), Some(index));
        let error = setup(planes, pins + 1).scene::<f64, 2, 2, Many>();
        let error = error.map(|_| ()).expect_err("256");
        assert_eq!(error.parameter, Parameter::CornerCount);
    }
}

/// A contact can number 128 vertices of a body.
#[test]
fn number_of_vertices_among_obstacles() {
    let ring = |n: usize| {
        changed(|s| {
            let angle = |i: usize| i as f64 * core::f64::consts::TAU / n as f64;
            s.body = (0..n)
                .map(|i| [0.5 * angle(i).cos(), 0.5 * angle(i).sin()])
                .collect();
        })
    };
    let scene = |n: usize| ring(n).scene::<f64, 200, 1, WithObstacles<2, 6>>();
    assert!(scene(128).is_ok());
    let error = scene(129).map(|_| ()).expect_err("too many");
    assert_eq!(
        error.to_string(),
        "number of vertices is 129.0, allowed: 1 to the capacity of the solver, and at most 128 among obstacles"
    );
}

fn corner(obstacle: usize, corner: usize) -> Parameter {
    Parameter::Corner { obstacle, corner }
}

#[test]
fn places_of_corners() {
    for (value, shown) in [
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
        (f64::NEG_INFINITY, "-inf"),
    ] {
        let text = std::format!("corner 1 of obstacle 1 is {shown}, allowed: finite numbers");
        refused_by_all(corner(1, 1), &text, |s| s.shapes[1].vertices[1][0] = value);
    }
    let text = "corner 1 of obstacle 1 is 2.0, allowed: a place of its own";
    refused_by_all(corner(1, 1), text, |s| s.shapes[1].vertices[1] = [2.0, 0.0]);
    let text = "corner 3 of obstacle 0 is 1.0, allowed: a place of its own";
    refused_by_all(corner(0, 3), text, |s| {
        s.shapes[0].vertices[3] = [1.0, -1.0]
    });
}

#[test]
fn corners_make_a_polygon() {
    let text = "corner 2 of obstacle 0 is -1.5, allowed: a corner of a strictly convex polygon, counter-clockwise";
    refused_by_all(corner(0, 2), text, |s| {
        s.shapes[0].vertices = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, -1.5]];
    });
    // Without an area, to within less than is distinguished, and dented.
    for out in [0.0, 2e-6, -0.5] {
        let text = "corner 2 of obstacle 0 is 0.5, allowed: a corner of a strictly convex polygon";
        refused_by_all(corner(0, 2), text, |s| {
            s.shapes[0].vertices = vec![[-1.0, 0.0], [1.0, 0.0], [0.5, out]];
        });
    }
    let text = "corner 2 of obstacle 0 is 1.0, allowed: a corner of a strictly convex polygon";
    refused_by_all(corner(0, 2), text, |s| s.shapes[0].vertices.reverse());
    // The corners of a star are on a circle.
    let star = changed(|s| {
        let at = |i: u32| (f64::from(i) * -0.8 * core::f64::consts::PI).sin_cos();
        s.shapes[0].vertices = (0..5).map(|i| at(i).into()).collect();
    });
    let error = star.scene::<f64, 4, 2, WithObstacles<6, 24>>();
    let error = error.map(|_| ()).expect_err("not convex");
    assert!(matches!(
        error.parameter,
        Parameter::Corner { obstacle: 0, .. }
    ));
}

#[test]
fn friction_and_memory_of_obstacles() {
    let text = "dynamic friction of obstacle 1 is -0.5, allowed: 0 or more";
    let parameter = Parameter::ObstacleFrictionDynamic(1);
    refused_by_all(parameter, text, |s| s.shapes[1].mu[1] = -0.5);
    let text = "static friction of obstacle 1 is 0.25, allowed: not less than the dynamic friction";
    let parameter = Parameter::ObstacleFrictionStatic(1);
    refused_by_all(parameter, text, |s| s.shapes[1].mu[0] = 0.25);
    refused_by_all(parameter, "static friction of obstacle 1 is NaN", |s| {
        s.shapes[1].mu[0] = f64::NAN
    });
    let text = "memory of obstacle 1 is -1.0, allowed: 0 or more";
    refused_by_all(Parameter::ObstacleMemory(1), text, |s| {
        s.shapes[1].memory = Some(-1.0)
    });

    let smooth = |mu: [f64; 2]| changed(|s| s.shapes.iter_mut().for_each(|shape| shape.mu = mu));
    type Smooth = WithObstacles<2, 6, Frictionless>;
    assert!(smooth([0.0; 2]).scene::<f64, 2, 1, Smooth>().is_ok());
    let error = smooth([0.5, 0.0]).scene::<f64, 2, 1, Smooth>();
    assert_eq!(
        error.map(|_| ()).expect_err("friction").to_string(),
        "static friction of obstacle 0 is 0.5, allowed: 0 in a model without friction"
    );
}

#[test]
fn sides_are_not_too_short() {
    let shortest = 1.0 / 65536.0;
    let parameter = Parameter::Side {
        obstacle: 1,
        side: 0,
    };
    refused_by_all(parameter, "length of side 0 of obstacle 1 is", |s| {
        s.shapes[1].vertices[1] = [2.0, 0.99 * shortest];
    });
    let parameter = Parameter::Side {
        obstacle: 0,
        side: 1,
    };
    let text =
        "length of side 1 of obstacle 0 is 7.62939453125e-6, allowed: at least 2^-16 body sizes";
    refused_by_all(parameter, text, |s| {
        s.shapes[0] = block([-1.0, -1.0], [2.0, 0.5 * shortest]);
        s.shapes[0].vertices.iter_mut().for_each(|v| v[1] += 1.0);
        s.shapes[0].vertices[2][1] = 0.5 * shortest;
        s.shapes[0].vertices[3][1] = 0.5 * shortest;
    });
    fn accepted<R: Real<Si: SiFloat>>(setup: &Setup) {
        assert!(setup.scene::<R, 4, 2, WithObstacles<6, 24>>().is_ok());
    }
    let setup = changed(|s| s.shapes[1].vertices[1] = [2.0, shortest]);
    in_all_numbers!(accepted, &setup);
}

/// The accepted range is what the number type represents.
#[test]
fn corners_are_in_the_range_of_the_number_type() {
    fn check<R: Real<Si: SiFloat>>() {
        let most = R::RANGE.to_si(R::Si::ONE).widen();
        let with = |x: f64| changed(|s| s.shapes[1] = shape(&[[0.8 * x, 0.4 * x]]));
        let scene = |part: f64| with(part * most).scene::<R, 4, 2, WithObstacles<6, 24>>();
        assert!(scene(0.999).is_ok());
        let error = scene(-1.001).map(|_| ()).expect_err("too far");
        assert_eq!(error.parameter, corner(1, 0));
        assert!((error.value.widen() / (-0.8 * 1.001 * most) - 1.0).abs() < 1e-6);
        assert!(
            error
                .allowed
                .starts_with("the larger coordinate and half the other at most ")
        );
    }
    in_all_numbers!(check);
}

/// The deepest start that is accepted is 1e-5 L, and next to a thin wall or a pin there is room.
#[test]
fn start_is_not_in_an_obstacle() {
    let text = "depth of the body in obstacle 0 at the start is 0.25, allowed: at most 1e-5";
    refused_by_all(Parameter::Overlap(0), text, |s| s.start = [0.0, -0.25, 0.0]);
    let text = "depth of the body in obstacle 1 at the start is 0.25, allowed: at most 1e-5";
    refused_by_all(Parameter::Overlap(1), text, |s| s.start = [1.75, 0.5, 0.0]);
    fn check<R: Real<Si: SiFloat>>() {
        let at = |start: [f64; 3]| {
            changed(|s| s.start = start)
                .scene::<R, 4, 2, WithObstacles<6, 24>>()
                .map(|_| ())
        };
        assert_eq!(at([0.0, -0.9e-5, 0.0]), Ok(()));
        assert!(at([0.0, -1.2e-5, 0.0]).is_err());
        assert_eq!(at([1.5 + 0.9e-5, 0.5, 0.0]), Ok(()));
        assert!(at([1.5 + 1.2e-5, 0.5, 0.0]).is_err());
        // On the wall's end, collinear with it, and across it: then its depth is the part above the rod.
        let upright = core::f64::consts::FRAC_PI_2;
        assert_eq!(at([2.0, 1.5, upright]), Ok(()));
        let error = at([2.0, 0.875, 0.0]).expect_err("across");
        assert_eq!(
            (error.parameter, error.value.widen()),
            (Parameter::Overlap(1), 0.125)
        );
    }
    in_all_numbers!(check);
}
