//! Obstacles clipped to what a number type can represent: corners beyond its range are replaced by corners at the edge of the range.
//! Converts from the obstacles of a file to those of the solver, and from the solver's indices back to the file's.

use stiction_core::{Parameter, Real, SceneError, SiFloat, Touch};

use crate::obstacle::ObstacleInfo;
use crate::written::WrittenScene;

/// The file's indices of the solver's obstacles, corners and sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indices(Vec<Remaining>);

/// An obstacle of which at least a part is in range.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Remaining {
    obstacle: usize,
    /// For each of its corners, the file's index, which is also that of the side that begins there; for an added corner, that of the
    /// previous corner.
    corners: Vec<usize>,
}

impl Indices {
    /// The touching features, with the indices of the file.
    #[must_use]
    pub fn touch(&self, touch: Touch) -> Touch {
        match touch {
            Touch::Surface { .. } => touch,
            Touch::Side {
                vertex,
                obstacle,
                side,
            } => {
                let (obstacle, side) = self.original(obstacle, side);
                Touch::Side {
                    vertex,
                    obstacle,
                    side,
                }
            }
            Touch::Corner {
                obstacle,
                corner,
                body_side,
            } => {
                let (obstacle, corner) = self.original(obstacle, corner);
                Touch::Corner {
                    obstacle,
                    corner,
                    body_side,
                }
            }
        }
    }

    /// The file's index of an obstacle of the solver.
    #[must_use]
    pub fn obstacle(&self, obstacle: usize) -> Option<usize> {
        self.0.get(obstacle).map(|remaining| remaining.obstacle)
    }

    /// The file's indices of an obstacle and a corner of it.
    fn original(&self, obstacle: usize, corner: usize) -> (usize, usize) {
        match self.0.get(obstacle) {
            Some(remaining) => {
                let corner = remaining.corners.get(corner).copied().unwrap_or(corner);
                (remaining.obstacle, corner)
            }
            None => (obstacle, corner),
        }
    }

    /// A refusal, with the indices of the file.
    pub(crate) fn error<F>(&self, error: SceneError<F>) -> SceneError<F> {
        let parameter = self.parameter(error.parameter);
        SceneError { parameter, ..error }
    }

    /// The refused parameter, with the indices of the file.
    #[must_use]
    pub fn parameter(&self, parameter: Parameter) -> Parameter {
        let whole = |obstacle| self.original(obstacle, 0).0;
        match parameter {
            Parameter::Corners(i) => Parameter::Corners(whole(i)),
            Parameter::Corner { obstacle, corner } => {
                let (obstacle, corner) = self.original(obstacle, corner);
                Parameter::Corner { obstacle, corner }
            }
            Parameter::Side { obstacle, side } => {
                let (obstacle, side) = self.original(obstacle, side);
                Parameter::Side { obstacle, side }
            }
            Parameter::ObstacleFrictionStatic(i) => Parameter::ObstacleFrictionStatic(whole(i)),
            Parameter::ObstacleFrictionDynamic(i) => Parameter::ObstacleFrictionDynamic(whole(i)),
            Parameter::ObstacleMemory(i) => Parameter::ObstacleMemory(whole(i)),
            Parameter::Overlap(i) => Parameter::Overlap(whole(i)),
            other => other,
        }
    }
}

/// A corner of a polygon that is being clipped.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    place: [f64; 2],
    /// The file's index of the corner; for an added one, that of the previous corner, on whose side it lies.
    number: usize,
    is_added: bool,
}

/// The obstacles of a scene within the range of a number type, and their indices in the file if any was clipped.
pub(crate) fn clipped<R: Real<Si: SiFloat>>(
    scene: &WrittenScene,
) -> (Vec<ObstacleInfo>, Option<Indices>) {
    let size = length(scene);
    // Slightly less, to allow for rounding.
    let range = (1.0 - 1e-6) * R::RANGE.to_si(R::Si::ONE).widen() * size;
    let origin = first_vertex(scene);
    let is_within = |corner: &[f64; 2]| beyond(sub(*corner, origin)) <= range;
    let mut corners = scene.obstacles.iter().flat_map(|o| &o.vertices);
    if corners.all(is_within) {
        return (scene.obstacles.clone(), None);
    }
    let (mut remaining, mut indices) = (Vec::new(), Vec::new());
    for (i, obstacle) in scene.obstacles.iter().enumerate() {
        let corner = |(number, &place)| Corner {
            place,
            number,
            is_added: false,
        };
        let corners: Vec<_> = obstacle.vertices.iter().enumerate().map(corner).collect();
        let corners = match obstacle.vertices.iter().all(is_within) {
            true => corners,
            false => within(corners, (origin, range), 1e-3 * size),
        };
        if corners.is_empty() {
            continue;
        }
        remaining.push(ObstacleInfo {
            vertices: corners.iter().map(|corner| corner.place).collect(),
            ..obstacle.clone()
        });
        indices.push(Remaining {
            obstacle: i,
            corners: corners.iter().map(|corner| corner.number).collect(),
        });
    }
    (remaining, Some(Indices(indices)))
}

/// Where the first vertex starts (m): the origin inside the solver.
fn first_vertex(scene: &WrittenScene) -> [f64; 2] {
    let [x, y, theta] = scene.start;
    let (sin, cos) = theta.sin_cos();
    let [a, b] = scene.vertices.first().copied().unwrap_or_default();
    [x + cos * a - sin * b, y + sin * a + cos * b]
}

/// The larger coordinate of a point plus half the other: the bound that a number type checks.
fn beyond([x, y]: [f64; 2]) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    x.max(y) + x.min(y) / 2.0
}

/// The part of a polygon, a wall or a pin within the range. Added corners are farther than `least` from each other and from the line
/// between their neighbours; of a thinner polygon nothing is left.
fn within(corners: Vec<Corner>, (origin, range): ([f64; 2], f64), least: f64) -> Vec<Corner> {
    let is_polygon = corners.len() > 2;
    let mut rest = corners;
    for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        for [a, b] in [[1.0, 0.5], [0.5, 1.0]] {
            let [a, b] = [a * signs[0], b * signs[1]];
            rest = cut(&rest, |place| {
                let [x, y] = sub(place, origin);
                range - a * x - b * y
            });
        }
    }
    let needless = |all: &[Corner], k: usize| {
        let at = |i: usize| all[i % all.len()].place;
        let (before, here, after) = (at(k + all.len() - 1), at(k), at(k + 1));
        let [to_here, on, chord] = [sub(here, before), sub(after, here), sub(after, before)];
        let off = (chord[0] * to_here[1] - chord[1] * to_here[0]).abs();
        let is_near = to_here[0].hypot(to_here[1]) < least || on[0].hypot(on[1]) < least;
        all[k].is_added && (is_near || off < least * chord[0].hypot(chord[1]))
    };
    while is_polygon && let Some(k) = (0..rest.len()).find(|&k| needless(&rest, k)) {
        rest.remove(k);
    }
    match is_polygon && rest.len() < 3 {
        true => Vec::new(),
        false => rest,
    }
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// The part in which `depth`, an affine function, is not negative.
fn cut(corners: &[Corner], depth: impl Fn([f64; 2]) -> f64) -> Vec<Corner> {
    let mut remaining = Vec::new();
    // A wall has one side, traversed in both directions.
    let sides = if corners.len() == 2 { 1 } else { corners.len() };
    for (k, &corner) in corners.iter().enumerate() {
        let (a, b) = (corner.place, corners[(k + 1) % corners.len()].place);
        let (at_a, at_b) = (depth(a), depth(b));
        if at_a >= 0.0 {
            remaining.push(corner);
        }
        if k < sides && at_a * at_b < 0.0 {
            let part = at_a / (at_a - at_b);
            remaining.push(Corner {
                place: [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis])),
                number: corner.number,
                is_added: true,
            });
        }
    }
    remaining
}

/// L (m): the body's largest vertex distance; for a point, the length that the solver assumes, a power of two.
fn length(scene: &WrittenScene) -> f64 {
    let apart = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let from = |a: &'_ [f64; 2]| {
        scene
            .vertices
            .iter()
            .map(|b| apart(a, b))
            .fold(0.0, f64::max)
    };
    let largest = scene.vertices.iter().map(from).fold(0.0, f64::max);
    if largest > 0.0 {
        return largest;
    }
    let mut square = scene.stiffness_rotation / scene.stiffness_translation;
    for (grip, vertex) in scene.holding_point.iter().zip(&scene.vertices) {
        square += apart(grip, vertex).powi(2);
    }
    let mut size = 1.0;
    if square > 0.0 && square.is_finite() {
        while size * size > 64.0 * square {
            size /= 2.0;
        }
        while 16.0 * size * size < square {
            size *= 2.0;
        }
    }
    size
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use stiction_core::Fixed;

    /// A rod of 1 m whose first vertex starts at the origin, and an obstacle with these corners.
    fn scene(corners: &str) -> WrittenScene {
        let text = format!(
            "[body]\nvertices = [[-0.5, 0.0], [0.5, 0.0]]\nstart = [0.5, 0.0, 0.0]\n[spring]\ntranslation = 1.0\nrotation = 1.0\n\
             [[obstacle]]\nname = \"far\"\nvertices = [[0.0, 40.0]]\nstatic = 0.5\ndynamic = 0.3\n\
             [[obstacle]]\nname = \"table\"\nvertices = {corners}\nstatic = 0.5\ndynamic = 0.3\n"
        );
        WrittenScene::parse(Source::new("made.toml", text), 1e9).expect("a sound scene")
    }

    fn assert_near(places: &[[f64; 2]], expected: &[[f64; 2]]) {
        assert_eq!(places.len(), expected.len(), "{places:?}");
        for (place, expected) in places.iter().zip(expected) {
            for axis in [0, 1] {
                assert!((place[axis] - expected[axis]).abs() < 1e-4, "{places:?}");
            }
        }
    }

    #[test]
    fn what_is_within_the_range_is_left_as_it_is() {
        let scene = scene("[[-30.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-30.0, 0.0]]");
        let (whole, indices) = clipped::<f32>(&scene);
        assert_eq!((whole, indices), (scene.obstacles, None));
    }

    #[test]
    fn a_table_that_goes_on_ends_at_the_range_and_keeps_its_names() {
        let scene = scene("[[-30.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-30.0, 0.0]]");
        let (cut, indices) = clipped::<Fixed>(&scene);
        // The pin is out of range.
        assert_eq!(cut.len(), 1);
        let corners = [[-15.5, -1.0], [0.0, -1.0], [0.0, 0.0], [-16.0, 0.0]];
        assert_near(&cut[0].vertices, &corners);
        // The program's tests hold its sides against their names.
        let surface = Touch::Surface {
            vertex: 3,
            surface: 0,
        };
        assert_eq!(indices.expect("something is cut").touch(surface), surface);
    }

    #[test]
    fn a_slanting_block_gets_corners_and_a_wall_gets_shorter() {
        let (cut, indices) = clipped::<Fixed>(&scene("[[0.0, 0.0], [20.0, 0.0], [0.0, 20.0]]"));
        let corners = [
            [0.0, 0.0],
            [16.0, 0.0],
            [12.0, 8.0],
            [8.0, 12.0],
            [0.0, 16.0],
        ];
        assert_near(&cut[0].vertices, &corners);
        let side = |side| Touch::Side {
            vertex: 0,
            obstacle: 0,
            side,
        };
        let original = |given| match indices.as_ref().map(|known| known.touch(side(given))) {
            Some(Touch::Side { side, .. }) => side,
            other => panic!("{other:?}"),
        };
        assert_eq!((original(0), original(2), original(4)), (0, 1, 2));
        let (cut, _) = clipped::<Fixed>(&scene("[[-20.0, 1.0], [3.0, 1.0]]"));
        assert_near(&cut[0].vertices, &[[-15.5, 1.0], [3.0, 1.0]]);
        let (cut, _) = clipped::<Fixed>(&scene("[[-20.0, 17.0], [3.0, 17.0]]"));
        assert!(cut.is_empty());
    }
}
