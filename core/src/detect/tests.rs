//! Gaps and the room to the nearest of them, against a loop over all vertices and surfaces.

use super::*;
use crate::fixtures::sampled;
use crate::geometry::Angle;
use crate::scene::{Description, Scene, SurfaceDescription};

type Room<R> = Scene<R, 5, 3>;

/// The origin of its frame is off centre.
const VERTICES: [[f64; 2]; 5] = [
    [3.5, 0.0],
    [3.15, 0.47],
    [2.6, 0.3],
    [2.6, -0.3],
    [3.15, -0.47],
];

/// A pentagon of about one body size among three planes.
fn scene<R: Real>(si: impl Fn(f64) -> R::Si, planes: [(f64, f64); 3]) -> Room<R> {
    let surfaces = planes.map(|(angle, offset)| SurfaceDescription {
        normal: [si(-libm::sin(angle)), si(libm::cos(angle))],
        offset: si(offset),
        friction_static: si(0.5),
        friction_dynamic: si(0.3),
        memory: None,
    });
    Scene::new(&Description {
        vertices: &VERTICES.map(|v| v.map(&si)),
        start: [si(-3.0), si(0.0), si(0.0)],
        weight: si(0.0),
        holding_point: None,
        reach: si(0.0),
        stiffness_translation: si(1.0),
        stiffness_rotation: si(1.0),
        surfaces: &surfaces,
        obstacles: &[],
    })
    .expect("a sound scene")
}

/// Poses near and far in a room with planes at some distances.
fn poses() -> impl Iterator<Item = ([(f64, f64); 3], [f64; 3])> {
    let rooms = [0.7, 2.0, 40.0, 900.0].map(|d| [(0.0, -d), (1.3, -1.2 * d), (-2.0, -1.5 * d)]);
    let places = [
        (0.0, 0.0),
        (0.1, 0.3),
        (-0.2, 1.0),
        (3.0, 2.0),
        (30.0, 20.0),
    ];
    let turns = [0.0, 0.4, 2.0, -1.1, 3.0];
    let all = rooms.into_iter().flat_map(move |room| {
        places
            .into_iter()
            .flat_map(move |(x, y)| turns.map(move |turn| (room, [x, y, turn])))
    });
    sampled(all, 7)
}

/// Placed by an arbitrary point, such as the holding point.
fn placed<R: Real>(si: impl Fn(f64) -> R::Si, [x, y, turn]: [f64; 3]) -> Placed<R> {
    let number = |x: f64| R::from_si(si(x), R::Si::ONE);
    Placed {
        point: Vec2::new(number(x), number(y)),
        body_point: Vec2::new(number(3.125), number(-0.25)),
        orientation: Orientation::new(Angle::from_radians(number(turn))),
        on: None,
    }
}

/// In f64, written out.
fn gap(scene: &Room<f64>, placed: &Placed<f64>, (vertex, surface): (u8, u8)) -> f64 {
    let (sin, cos) = libm::sincos(placed.orientation.angle().radians());
    let Vec2 { x, y } = scene.vertex(vertex) - placed.body_point;
    let at = placed.point + Vec2::new(cos * x - sin * y, sin * x + cos * y);
    let surface = scene.surface(surface);
    surface.normal.x * at.x + surface.normal.y * at.y - surface.offset
}

#[test]
fn gap_is_known_to_its_rounding() {
    for (planes, pose) in poses() {
        let (exact, coarse) = (
            scene::<f64>(|x| x, planes),
            scene::<f32>(|x| x as f32, planes),
        );
        let (at, rounded) = (
            placed::<f64>(|x| x, pose.map(|x| f64::from(x as f32))),
            placed::<f32>(|x| x as f32, pose),
        );
        for (vertex, surface) in (0..5).flat_map(|v| (0..3).map(move |s| (v, s))) {
            let contact = Pair { vertex, surface };
            let should = gap(&exact, &at, (vertex, surface));
            assert!((at.gap(&exact, contact) - should).abs() <= 1e-12 * (1.0 + should.abs()));
            let arm = rounded.arm(&coarse, vertex);
            let (is, rounding) = rounded.gap_at(&coarse, contact, arm);
            assert_eq!(is, rounded.gap(&coarse, contact));
            let off = (f64::from(is) - should).abs();
            assert!(off <= 3.0 * f64::from(rounding), "{off} {rounding}");
            let offset = f64::from(coarse.surface(surface).offset.abs());
            let size = 1.0 + pose[0].abs() + pose[1].abs() + offset;
            let least = f64::from(f32::EPSILON) * size;
            assert!((least..=4.0 * least).contains(&f64::from(rounding)));
        }
    }
}

/// The room is the least gap of all, less a touch and its rounding; if all are far away it may be less, never more.
#[test]
fn room_is_the_least_gap() {
    let (mut near, mut far) = (0, 0);
    for (planes, pose) in poses() {
        let scene = scene::<f64>(|x| x, planes);
        let at = placed::<f64>(|x| x, pose);
        let all = (0..5).flat_map(|v| (0..3).map(move |s| (v, s)));
        let least = all
            .map(|pair| gap(&scene, &at, pair))
            .fold(f64::INFINITY, f64::min);
        let room = at.room(&scene, None);
        let touch = <f64 as Real>::TOUCH;
        let coarse = self::scene::<f32>(|x| x as f32, planes);
        let rounded = placed::<f32>(|x| x as f32, pose).room(&coarse, None);
        assert!(f64::from(rounded) <= least, "{rounded} {least}");
        assert!(room <= least - touch, "{room} {least}");
        if least < 0.9 {
            assert!(room >= least - 1.1 * touch, "{room} {least}");
            near += 1;
        } else {
            assert!(room >= 0.25 * least, "{room} {least}");
            far += 1;
        }
        let swings = |turn: f64| at.is_clear(&scene, turn * turn);
        // No vertex is farther from the point than 1: the displacement of a turn, and half of twice as much.
        if room > 0.0 {
            assert!(swings(0.9 * libm::sqrt(room)) && !swings(1.6 * libm::sqrt(room)));
        } else {
            assert!(!swings(0.0));
        }
    }
    assert!(cfg!(miri) || near > 10 && far > 10, "{near} {far}");
}
