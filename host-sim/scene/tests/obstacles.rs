//! Obstacles of a scene file: what is read, which scenes they make, and what a solver without obstacles refuses.

use stiction_core::{Evolution, Fixed, Hand, Real, SiFloat, Solver, Touch};
use stiction_scene::{HostSolver, SceneFile, SceneModel, Source};

const SCENE: &str = r#"grasp = { point = [0.0, 0.02] }
spring = { translation = 500.0, rotation = 0.5 }
friction = { static = 0.5, dynamic = 0.3, memory = 1e-4 }

[body]
rectangle = [0.10, 0.06]
start = [0.0, 0.03, 0.0]
weight = 2.0

[[surface]]
name = "wall"
normal = [1.0, 0.0]
offset = -1.0

[[obstacle]]
name = "table"
vertices = [[-0.5, -0.1], [0.5, -0.1], [0.5, 0.0], [-0.5, 0.0]]

[[obstacle]]
vertices = [[0.0, 0.3]]
static = 0.8
dynamic = 0.7
memory = 0.0
"#;

fn scene(text: &str) -> SceneFile {
    SceneFile::parse(Source::new("made.toml", text), f64::from(f32::MAX)).expect("a scene")
}

#[test]
fn friction_is_that_of_the_file_unless_it_is_given() {
    let scene = scene(SCENE);
    let [table, pin] = scene.obstacles.as_slice() else {
        panic!("{:?}", scene.obstacles);
    };
    assert_eq!((table.name.as_str(), pin.name.as_str()), ("table", "1"));
    assert_eq!((table.vertices.len(), pin.vertices.len()), (4, 1));
    let friction =
        |o: &stiction_scene::ObstacleInfo| (o.friction_static, o.friction_dynamic, o.memory);
    assert_eq!(friction(table), (0.5, 0.3, Some(1e-4)));
    assert_eq!(friction(pin), (0.8, 0.7, Some(0.0)));
}

fn touched<R: Real<Si: SiFloat>>(text: &str) -> Vec<Touch> {
    let (scene, indices) = scene(text).written.scene_in().expect("sound");
    let solver: HostSolver<R> = Solver::new(scene, Evolution::Path);
    let hand = Hand::new(R::Si::narrow(0.0), R::Si::narrow(0.05), R::Si::narrow(0.0));
    let (state, _) = solver.start(hand);
    let original = |touch| indices.as_ref().map_or(touch, |known| known.touch(touch));
    let contacts = solver.contacts(&state);
    contacts.iter().map(|c| original(c.touch)).collect()
}

/// Side 2 of the table, however far away its end is.
#[test]
fn a_table_that_is_cut_is_touched_by_its_own_side() {
    let both = [0, 1].map(|vertex| Touch::Side {
        vertex,
        obstacle: 0,
        side: 2,
    });
    let far = SCENE.replace("0.5, -0.1], [0.5, 0.0]", "7.0, -8.0], [7.0, 0.0]");
    assert_ne!(far, SCENE);
    let pin = "[[obstacle]]\nvertices = [[0.0, 0.3]]";
    let farther = far.replace(pin, "[[obstacle]]\nvertices = [[0.0, 30.0]]");
    for text in [SCENE, &far, &farther] {
        assert_eq!(touched::<f32>(text), both);
        assert_eq!(touched::<Fixed>(text), both);
    }
}

#[test]
fn a_board_has_room_for_the_corners_of_its_scene() {
    assert_eq!(SceneModel::smallest(&scene(SCENE)).corners, 5);
}
