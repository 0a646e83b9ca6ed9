//! Obstacles cut to what a number type can represent: a corner beyond its range is replaced by two at the edge of the range, which
//! nothing reaches. From the obstacles of a file to those of the solver, and from the solver's indices back to the file's.

use stiction_core::{Real, SceneError, SiFloat, Touch};

use crate::obstacle::ObstacleInfo;
use crate::written::WrittenScene;

/// What the solver's obstacles, corners and sides are in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indices(Vec<Kept>);

/// An obstacle of which something is within reach.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Kept {
    obstacle: usize,
    /// For each of its corners the file's, which is also the name of the side that begins there; of an added corner the one before it.
    corners: Vec<usize>,
}

impl Indices {
    /// What touches what, by the indices of the file.
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

    /// An obstacle and a corner of it.
    fn original(&self, obstacle: usize, corner: usize) -> (usize, usize) {
        match self.0.get(obstacle) {
            Some(kept) => {
                let corner = kept.corners.get(corner).copied().unwrap_or(corner);
                (kept.obstacle, corner)
            }
            None => (obstacle, corner),
        }
    }

    /// A refusal, by the indices of the file.
    pub(crate) fn error<F>(&self, error: SceneError<F>) -> SceneError<F> {
        error
    }
}

/// A corner with the number of the file's corner.
type Labelled = ([f64; 2], usize);

/// The obstacles of a scene within the range of a number type, and what they are in the file where any was cut.
pub(crate) fn clipped<R: Real<Si: SiFloat>>(
    scene: &WrittenScene,
) -> (Vec<ObstacleInfo>, Option<Indices>) {
    // A little less, for rounding.
    let range = (1.0 - 1e-6) * R::RANGE.to_si(R::Si::ONE).widen() * length(scene);
    let is_within = |corner: &[f64; 2]| corner.iter().all(|x| x.abs() <= range);
    let mut corners = scene.obstacles.iter().flat_map(|o| &o.vertices);
    if corners.all(is_within) {
        return (scene.obstacles.clone(), None);
    }
    let (mut kept, mut indices) = (Vec::new(), Vec::new());
    for (i, obstacle) in scene.obstacles.iter().enumerate() {
        let labelled = obstacle.vertices.iter().copied().zip(0..).collect();
        let corners = within(labelled, range, 1e-3 * length(scene));
        if corners.is_empty() {
            continue;
        }
        kept.push(ObstacleInfo {
            vertices: corners.iter().map(|(place, _)| *place).collect(),
            ..obstacle.clone()
        });
        indices.push(Kept {
            obstacle: i,
            corners: corners.iter().map(|(_, corner)| *corner).collect(),
        });
    }
    (kept, Some(Indices(indices)))
}

/// The part of a polygon, a wall or a pin in the square |x|, |y| <= `range`, without sides shorter than `least`.
fn within(corners: Vec<Labelled>, range: f64, least: f64) -> Vec<Labelled> {
    let sides = [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)];
    let is_whole = |([x, y], _): &Labelled| x.abs() <= range && y.abs() <= range;
    if corners.iter().all(is_whole) {
        return corners;
    }
    let mut rest = corners;
    for (axis, sign) in sides {
        rest = cut(&rest, |place| range - sign * place[axis]);
    }
    // A corner at the edge of the square leaves two that are one.
    let all = rest.clone();
    let next = |k: usize| all[(k + 1) % all.len()].0;
    let mut k = 0..all.len();
    rest.retain(|([x, y], _)| {
        let [next_x, next_y] = next(k.next().unwrap_or_default());
        all.len() < 3 || (next_x - x).hypot(next_y - y) > least
    });
    rest
}

/// The part where `depth`, an affine function, is not negative.
fn cut(corners: &[Labelled], depth: impl Fn([f64; 2]) -> f64) -> Vec<Labelled> {
    let mut kept = Vec::new();
    // A wall has one side, there and back.
    let sides = if corners.len() == 2 { 1 } else { corners.len() };
    for (k, &(a, label)) in corners.iter().enumerate() {
        let (b, _) = corners[(k + 1) % corners.len()];
        let (at_a, at_b) = (depth(a), depth(b));
        if at_a >= 0.0 {
            kept.push((a, label));
        }
        if k < sides && at_a * at_b < 0.0 {
            let part = at_a / (at_a - at_b);
            let crossing = [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
            kept.push((crossing, label));
        }
    }
    kept
}

/// L (m): the body's largest vertex distance; that of a point as the solver takes it, a power of two.
fn length(scene: &WrittenScene) -> f64 {
    let apart = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let others = scene.vertices.iter().flat_map(|a| {
        let distances = scene.vertices.iter().map(move |b| apart(a, b));
        distances
    });
    let largest = others.fold(0.0, f64::max);
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

    /// A rod of 1 m and an obstacle of these corners.
    fn scene(corners: &str) -> WrittenScene {
        let text = format!(
            "[body]\nvertices = [[-0.5, 0.0], [0.5, 0.0]]\nstart = [0.0, 1.0, 0.0]\n[spring]\ntranslation = 1.0\nrotation = 1.0\n\
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
        // Nothing reaches the pin.
        assert_eq!(cut.len(), 1);
        let corners = [[-16.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-16.0, 0.0]];
        assert_near(&cut[0].vertices, &corners);
        let indices = indices.expect("something is cut");
        let (vertex, obstacle) = (3, 0);
        for side in [1, 2] {
            let touch = Touch::Side {
                vertex,
                obstacle,
                side,
            };
            let expected = Touch::Side {
                vertex,
                obstacle: 1,
                side,
            };
            assert_eq!(indices.touch(touch), expected);
        }
        let surface = Touch::Surface { vertex, surface: 0 };
        assert_eq!(indices.touch(surface), surface);
    }

    #[test]
    fn a_slanting_block_gets_corners_and_a_wall_gets_shorter() {
        let (cut, indices) = clipped::<Fixed>(&scene("[[0.0, 0.0], [20.0, 0.0], [0.0, 20.0]]"));
        let corners = [
            [0.0, 0.0],
            [16.0, 0.0],
            [16.0, 4.0],
            [4.0, 16.0],
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
        assert_near(&cut[0].vertices, &[[-16.0, 1.0], [3.0, 1.0]]);
        let (cut, _) = clipped::<Fixed>(&scene("[[-20.0, 17.0], [3.0, 17.0]]"));
        assert!(cut.is_empty());
    }
}
