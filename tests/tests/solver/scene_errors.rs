//! An unusable scene is refused, and the error names the parameter, its value and what is allowed.

use stiction_core::{Evolution, Fixed, Parameter, Real, StateKind};
use stiction_tests::laws::assert_lawful;
use stiction_tests::run::{planar, polyline, run};
use stiction_tests::setup::{SURFACES, VERTICES};
use stiction_tests::{Number, Run, Setup};

/// A valid scene with one parameter changed.
fn changed(change: impl Fn(&mut Setup)) -> Setup {
    let mut setup = Setup::block(2.0, 1.0).floor([0.5, 0.3]);
    change(&mut setup);
    setup
}

#[track_caller]
fn refused<R: Number>(setup: &Setup, parameter: Parameter, value: f64) {
    let Err(error) = setup.scene::<R>() else {
        panic!("{}: {parameter} of {value} is accepted", R::NAME);
    };
    assert_eq!(error.parameter, parameter);
    let got = R::wide(error.value);
    // A depth is accurate to a rounding of the body's size.
    let carried = match parameter {
        Parameter::Penetration { .. } => R::ROUNDING * setup.size(),
        _ => 0.0,
    };
    let near = (got - value).abs() <= 1e-6 * value.abs() + carried;
    assert!(
        near || got == value || (got.is_nan() && value.is_nan()),
        "{parameter}: {got} instead of {value}"
    );
    let message = error.to_string();
    assert!(
        message.contains(&parameter.to_string()) && message.contains(error.allowed),
        "{message}"
    );
}

#[track_caller]
fn refused_by_all(parameter: Parameter, value: f64, change: impl Fn(&mut Setup)) {
    let setup = changed(change);
    refused::<f64>(&setup, parameter, value);
    refused::<f32>(&setup, parameter, value);
    refused::<Fixed>(&setup, parameter, value);
}

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[test]
fn sound_scene_is_accepted() {
    assert!(changed(|_| ()).scene::<f64>().is_ok());
    assert!(changed(|_| ()).scene::<f32>().is_ok());
    assert!(changed(|_| ()).scene::<Fixed>().is_ok());
}

#[test]
fn number_of_vertices() {
    let ring = |n: usize| {
        (0..n)
            .map(|i| (i as f64).sin_cos().into())
            .collect::<Vec<[f64; 2]>>()
    };
    refused_by_all(Parameter::VertexCount, 0.0, |s| s.vertices.clear());
    refused_by_all(Parameter::VertexCount, (VERTICES + 1) as f64, |s| {
        s.vertices = ring(VERTICES + 1)
    });
}

#[test]
fn vertex() {
    for value in NOT_FINITE {
        refused_by_all(Parameter::Vertex(2), value, |s| s.vertices[2][1] = value);
    }
    refused_by_all(Parameter::Vertex(1), -1.0, |s| {
        s.vertices[1] = s.vertices[0]
    });
    let dent = changed(|s| s.vertices[2] = [-0.5, 0.3]);
    let clockwise = changed(|s| s.vertices.reverse());
    for setup in [dent, clockwise] {
        let error = setup.scene::<f64>().expect_err("not convex or clockwise");
        assert!(matches!(error.parameter, Parameter::Vertex(_)), "{error}");
    }
}

/// A vertex in a side or in the opposite one: three vertices cannot touch a surface simultaneously.
#[test]
fn vertex_hardly_out_of_line() {
    for out in [-1e-3, 0.0, 1e-9, 1e-7, 1e-6, 3e-6] {
        refused_by_all(Parameter::Vertex(2), 1.0, |s| {
            s.vertices = vec![[-1.0, 0.0], [0.1, -2.0 * out], [1.0, 0.0], [0.0, 1.0]];
        });
        refused_by_all(Parameter::Vertex(2), 1.0, |s| {
            s.vertices = vec![[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0 * out], [-1.0, 2.0 * out]];
        });
    }
    for out in [4e-5, 1e-3] {
        let bent = changed(|s| {
            s.vertices = vec![[-1.0, 0.0], [0.1, -2.0 * out], [1.0, 0.0], [0.0, 1.0]];
            s.start = [0.0, 1.0, 0.0];
        });
        assert!(bent.scene::<f64>().is_ok() && bent.scene::<f32>().is_ok());
        assert!(bent.scene::<Fixed>().is_ok());
    }
}

#[test]
fn start_pose() {
    for k in 0..3 {
        refused_by_all(Parameter::Start, f64::NAN, |s| s.start[k] = f64::NAN);
        refused_by_all(Parameter::Start, f64::INFINITY, |s| {
            s.start[k] = f64::INFINITY
        });
    }
    refused_by_all(Parameter::Start, 1e13, |s| s.start[1] = 1e13);
    refused_by_all(Parameter::Start, 1e30, |s| s.start[2] = 1e30);
}

/// For a position, the error reports the larger coordinate, with its sign.
#[test]
fn places_are_reported_by_the_larger_coordinate() {
    for far in [1e13, -1e13] {
        for place in [[far, 0.0], [0.5 * far, far], [far, -0.5 * far]] {
            refused_by_all(Parameter::Start, far, |s| {
                s.start = [place[0], place[1], 0.0]
            });
            refused_by_all(Parameter::HoldingPoint, far, |s| {
                s.holding_point = Some(place)
            });
        }
        refused_by_all(Parameter::Vertex(0), far, |s| {
            s.vertices = vec![[-1.0, far], [1.0, far]];
        });
    }
    // So it is if the position is wrong relative to the others.
    refused_by_all(Parameter::Vertex(3), 1.5, |s| {
        (s.vertices[2], s.vertices[3]) = ([-0.5, 0.3], [-1.0, 1.5]);
    });
}

/// Inserts a number into a valid scene.
type Change = fn(&mut Setup, f64);

/// A part of a number is accepted up to 1, and the error beyond states that number.
fn goes_up_to<R: Number>(parameter: Parameter, most: f64, change: impl Fn(&mut Setup, f64)) {
    let with = |part: f64| changed(|s| change(s, part)).scene::<R>();
    assert!(with(0.999).is_ok(), "{parameter}");
    let error = with(1.001).map(|_| ()).expect_err("too large");
    assert_eq!(error.parameter, parameter);
    let words = error.allowed.split([' ', ',']);
    let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
    assert_eq!(numbers, [most], "{parameter}: {}", error.allowed);
}

/// If a number is too large for the type, the error states the largest number that the type represents: a scene with that
/// number is accepted, and one beyond it is refused.
#[test]
fn allowed_numbers_are_those_that_are_carried() {
    fn check<R: Number>() {
        // Coordinates count from where the body starts: that itself is a number of the outside float.
        for change in [|far: f64| [0.0, far, 0.0], |far| [far, 0.4 * far, 0.0]] {
            let most = R::wide(R::Si::RANGE);
            goes_up_to::<R>(Parameter::Start, most, |s, part| {
                s.surfaces.clear();
                s.start = change(part * most * s.size());
            });
        }
        let most = R::wide(R::RANGE.to_si(R::si(1.0)));
        let changes: [(Parameter, Change); 4] = [
            (Parameter::HoldingPoint, |s, far| {
                s.holding_point = Some([-far, 0.0])
            }),
            (Parameter::Offset(0), |s, far| s.surfaces[0].offset = -far),
            // k_h is 1 and the surface is below the body.
            (Parameter::Weight, |s, far| s.weight = far),
            (Parameter::StiffnessRotation, |s, far| {
                let size = s.size();
                s.stiffness_rotation = far * size;
            }),
        ];
        for (parameter, change) in changes {
            goes_up_to::<R>(parameter, most, |s, part| {
                let size = s.size();
                change(s, part * most * size);
            });
        }
        let soft = changed(|s| s.stiffness_translation = 1e-40).scene::<R>();
        let allowed = soft.map(|_| ()).expect_err("too soft").allowed;
        let least = 1.0 / R::wide(R::Si::HUGE);
        let mut words = allowed
            .split([' ', ','])
            .filter_map(|word| word.parse().ok());
        let named: f64 = words.next().expect("a number");
        assert!((named / least - 1.0).abs() < 1e-6, "{allowed}");
    }
    check::<f64>();
    check::<f32>();
    check::<Fixed>();
}

#[test]
fn weight_and_reach() {
    for value in NOT_FINITE.into_iter().chain([-1.0]) {
        refused_by_all(Parameter::Weight, value, |s| s.weight = value);
        refused_by_all(Parameter::Reach, value, |s| s.reach = value);
    }
}

#[test]
fn holding_point() {
    for value in NOT_FINITE {
        refused_by_all(Parameter::HoldingPoint, value, |s| {
            s.holding_point = Some([0.0, value])
        });
    }
}

#[test]
fn stiffnesses() {
    for value in NOT_FINITE.into_iter().chain([-1.0]) {
        refused_by_all(Parameter::StiffnessTranslation, value, |s| {
            s.stiffness_translation = value
        });
        refused_by_all(Parameter::StiffnessRotation, value, |s| {
            s.stiffness_rotation = value
        });
    }
    refused_by_all(Parameter::StiffnessTranslation, 0.0, |s| {
        s.stiffness_translation = 0.0
    });
    assert!(
        changed(|s| s.stiffness_rotation = 0.0)
            .scene::<f64>()
            .is_ok()
    );
}

/// L, k_h L and k_h L² are divisors: each of them, even the last, has to be within the float's range.
#[test]
fn units() {
    let sized = |size: f64, k_h: f64| {
        changed(|s| {
            for vertex in &mut s.vertices {
                *vertex = vertex.map(|x| x * size);
            }
            (s.stiffness_translation, s.stiffness_rotation) = (k_h, 0.0);
        })
    };
    for (size, k_h) in [
        (1e-16, 1e20),
        (1e3, 1e-19),
        (1e-6, 1e-5),
        (1e10, 1e25),
        (1e10, 1e35),
    ] {
        refused::<f32>(&sized(size, k_h), Parameter::StiffnessTranslation, k_h);
    }
    for (size, k_h) in [(1e-14, 1e20), (1e3, 1e-15), (1e-6, 1.0), (1e10, 1e15)] {
        assert!(sized(size, k_h).scene::<f32>().is_ok(), "{size} {k_h}");
    }
}

#[test]
fn number_of_surfaces() {
    let crowd = |s: &mut Setup| s.surfaces = vec![s.surfaces[0]; SURFACES + 1];
    refused_by_all(Parameter::SurfaceCount, (SURFACES + 1) as f64, crowd);
}

#[test]
fn surface() {
    for value in NOT_FINITE {
        refused_by_all(Parameter::Offset(0), value, |s| {
            s.surfaces[0].offset = value
        });
        refused_by_all(Parameter::FrictionStatic(0), value, |s| {
            s.surfaces[0].friction_static = value
        });
        refused_by_all(Parameter::FrictionDynamic(0), value, |s| {
            s.surfaces[0].friction_dynamic = value
        });
    }
    refused_by_all(Parameter::Normal(0), 0.0, |s| {
        s.surfaces[0].normal = [0.0; 2]
    });
    refused_by_all(Parameter::Normal(0), f64::NAN, |s| {
        s.surfaces[0].normal[0] = f64::NAN
    });
    // Too long for the number type, although each component is representable.
    refused_by_all(Parameter::Normal(0), f64::INFINITY, |s| {
        s.surfaces[0].normal = [1.5e308; 2]
    });
    refused_by_all(Parameter::FrictionDynamic(0), -0.1, |s| {
        s.surfaces[0].friction_dynamic = -0.1
    });
    refused_by_all(Parameter::FrictionStatic(0), 0.2, |s| {
        s.surfaces[0].friction_static = 0.2
    });
}

#[test]
fn penetration_at_the_start() {
    let parameter = Parameter::Penetration {
        surface: 0,
        vertex: 1,
    };
    refused_by_all(parameter, 0.25, |s| {
        s.start = [0.0, -0.25 + 1f64.sin(), -1.0]
    });
    let within = 0.9e-5 * changed(|_| ()).size();
    assert!(changed(|s| s.start[1] = -within).scene::<f64>().is_ok());
    refused_by_all(
        Parameter::Penetration {
            surface: 0,
            vertex: 0,
        },
        3e-5,
        |s| s.start[1] = -3e-5,
    );
}

/// Every parameter has its own name, with the indices that it refers to.
#[test]
fn parameters_are_named() {
    use Parameter as P;
    let names = |i: usize, j: usize| {
        let each = [
            P::VertexCount,
            P::Vertex(i),
            P::Start,
            P::Weight,
            P::HoldingPoint,
            P::Reach,
            P::StiffnessTranslation,
            P::StiffnessRotation,
            P::SurfaceCount,
            P::Normal(i),
            P::Offset(i),
            P::FrictionStatic(i),
            P::FrictionDynamic(i),
            P::Penetration {
                surface: i,
                vertex: j,
            },
            P::ObstacleCount,
            P::CornerCount,
            P::Corners(i),
            P::Corner {
                obstacle: i,
                corner: j,
            },
            P::Side {
                obstacle: i,
                side: j,
            },
            P::ObstacleFrictionStatic(i),
            P::ObstacleFrictionDynamic(i),
            P::ObstacleMemory(i),
            P::Overlap(i),
        ];
        each.map(|parameter| parameter.to_string())
    };
    let all = names(17, 23);
    for (k, name) in all.iter().enumerate() {
        assert!(!name.is_empty() && !all[..k].contains(name), "{name}");
    }
    for (name, other) in all.iter().zip(names(3, 5)) {
        assert_eq!(name.replace("17", "3").replace("23", "5"), other);
    }
    let with = |index: &str| all.iter().filter(|name| name.contains(index)).count();
    assert_eq!((with("17"), with("23")), (13, 3));
}

/// A body farther from a surface than 1e-5 of its size does not touch it at the start, and is not moved there.
#[test]
fn gap_at_the_start() {
    fn starts<R: Number>() {
        for (gap, count) in [(0.9e-5, 2), (3e-5, 0), (1e-3, 0), (5e-3, 0)] {
            let l = changed(|_| ()).size();
            let setup = changed(|s| s.start[1] = gap * l);
            let absent = planar::<R>([0.0; 3]).released();
            let frame = Run::<R>::start_with(&setup, Evolution::Path, absent).frame;
            assert_eq!(frame.contacts.len(), count, "{} at {gap} L", R::NAME);
            let moved = (frame.pose[1] - setup.start[1]).abs();
            let allowed = if count == 0 { R::GAP } else { 1e-5 } * l;
            assert!(moved <= allowed, "{} at {gap} L: {moved}", R::NAME);
        }
    }
    starts::<f64>();
    starts::<f32>();
    starts::<Fixed>();
}

/// A plate as thin as 1 : 100 000 is a valid body in `f64`. Set onto the floor slightly too deep, with all its vertices within the
/// tolerance of a touch, it stands on two of them and obeys the laws; thinner plates are refused.
#[test]
fn thinnest_body_follows_from_the_number_type() {
    fn thinnest<R: Number>() -> Option<f64> {
        let thin = |thickness: f64| {
            Setup::block(1.0, thickness)
                .held_at([0.5, 0.0])
                .at([0.0, -0.9e-5, 0.0])
                .floor([0.5, 0.3])
        };
        let is_body = |thickness: &f64| thin(*thickness).scene::<R>().is_ok();
        let thicknesses = [1e-6, 3e-6, 1e-5, 2e-5, 4e-5];
        let thinnest = thicknesses.into_iter().find(is_body)?;
        let setup = thin(thinnest);
        for evolution in Evolution::ALL {
            let [x, y] = setup.grip();
            let hands = [
                [x, y - 0.1, 0.0],
                [x + 0.3, y - 0.1, -0.1],
                [x, y + 0.1, 0.2],
            ];
            let frames = run::<R>(&setup, evolution, &polyline(&hands, 100));
            assert_lawful::<R>(&setup, &frames);
            let at_first = frames
                .first()
                .map(|frame| (frame.state, frame.contacts.len()));
            assert_eq!(at_first, Some((StateKind::Edge, 2)));
        }
        Some(thinnest)
    }
    assert_eq!(thinnest::<f64>(), Some(1e-5));
    assert_eq!(thinnest::<f32>(), Some(4e-5));
    assert_eq!(thinnest::<Fixed>(), Some(2e-5));
}
