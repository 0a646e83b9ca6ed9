//! Text as a scene file: either it is refused with a message that names the file, or it yields a scene that every
//! number type starts or refuses with such a message, and code for a board.

use stiction_core::{Evolution, Fixed, Hand, Real, SiFloat, Solver, Status};
use stiction_scene::{InputError, Motion, SceneFile, Source};

/// # Panics
/// If a property is violated.
pub fn scene_file(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    starts::<f64>(text, f64::MAX);
    starts::<f32>(text, f32::MAX.into());
    starts::<Fixed>(text, f32::MAX.into());
}

/// An accepted scene starts with the body where the file places it.
fn starts<R: Real<Si: SiFloat>>(text: &str, limit: f64) {
    let file = match SceneFile::parse(Source::new("scene.toml", text), limit) {
        Err(error) => return is_clear(&error),
        Ok(file) => file,
    };
    if let Some(Motion::Keyframes(path)) = &file.hand.motion {
        let times: Vec<_> = path.frames(None).map(|sample| sample.t).collect();
        assert!(times.is_sorted_by(|a, b| a < b), "times increase");
    }
    let scene = match file.scene::<R>() {
        Err(error) => return is_clear(&error),
        Ok(scene) => scene,
    };
    let solver = Solver::new(scene, Evolution::Path);
    // Where the body is: farther away than its number type reaches, a hand would be reported.
    let [x0, y0, _] = file.start;
    let (_, output) = solver.start(Hand {
        position: [x0, y0].map(R::Si::narrow),
        ..Hand::default()
    });
    let [x, y] = output.position.map(SiFloat::widen);
    let (theta, length) = (output.angle.radians().widen(), size(&file));
    assert!(
        [x, y, theta].iter().all(|number| number.is_finite()),
        "{output:?}"
    );
    assert_eq!(
        output.status,
        Status::Ok,
        "status of a body that is not held"
    );
    let off = (x - x0).hypot(y - y0);
    let allowed = 1e-4 * (length + x0.abs() + y0.abs());
    assert!(off <= allowed, "the body starts {off} from its start pose");
}

/// The largest distance of a vertex from the body's origin.
fn size(file: &SceneFile) -> f64 {
    let far = file.vertices.iter().map(|[x, y]| x.hypot(*y));
    far.fold(0.0, f64::max)
}

/// A message names the file and fits on a screen.
pub(crate) fn is_clear(error: &InputError) {
    let message = error.to_string();
    assert!(
        message.contains("scene.toml") || message.contains("path."),
        "{message}"
    );
    assert!(message.chars().count() < 2000, "{message}");
}
