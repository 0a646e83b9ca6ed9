//! The report of a run in which the body touches nothing: how near it came to the surfaces.

use libm::sincos;
use stiction_live::record::Frame;
use stiction_scene::WrittenScene;

/// The least gap between a vertex and a surface over all frames, as long as nothing touches.
#[derive(Clone, Debug)]
pub(super) struct Nearest {
    scene: WrittenScene,
    touches: bool,
    least: f64,
    /// The surface of that gap.
    surface: usize,
}

impl Nearest {
    pub(super) fn new(scene: &WrittenScene) -> Self {
        Self {
            scene: scene.clone(),
            touches: false,
            least: f64::INFINITY,
            surface: 0,
        }
    }

    pub(super) fn add(&mut self, frame: &Frame) {
        self.touches |= !frame.contacts.is_empty();
        if self.touches {
            return;
        }
        let [x, y, theta] = frame.pose;
        let (sin, cos) = sincos(theta);
        for (k, surface) in self.scene.surfaces.iter().enumerate() {
            let [nx, ny] = surface.normal;
            for [a, b] in &self.scene.vertices {
                let at = [x + cos * a - sin * b, y + sin * a + cos * b];
                let gap = nx * at[0] + ny * at[1] - surface.offset;
                if gap < self.least {
                    (self.least, self.surface) = (gap, k);
                }
            }
        }
    }

    /// A sentence, if nothing was touched and there is a surface.
    pub(super) fn text(&self) -> Option<String> {
        let surface = self.scene.surfaces.get(self.surface)?;
        let millimetres = 1e3 * self.least;
        (!self.touches).then(|| {
            format!(
                "the body touches nothing: it is never nearer than {millimetres:.3} mm to surface {:?}",
                surface.name
            )
        })
    }
}
