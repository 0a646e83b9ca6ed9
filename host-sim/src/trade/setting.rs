//! The available choices: number type, evolution, memory length and frame rate.

use stiction_core::Evolution;
use stiction_scene::SceneFile;

use stiction_live::number::Number;

/// Frame rates (Hz): the paper's tracker, a motion capture, a haptic device.
pub const RATES: [f64; 3] = [31.0, 100.0, FINEST];

/// The rate (Hz) at which the references run.
pub const FINEST: f64 = 1000.0;

/// The sliding distance over which a contact renews.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory {
    /// The name in tables.
    pub name: &'static str,
    /// As a fraction of the body size, on every surface; `None`: the default of a scene that specifies none.
    length: Option<f64>,
}

impl Memory {
    /// The default of a scene that specifies none.
    pub const DEFAULT: Self = Self {
        name: "2^-12",
        length: None,
    };

    /// The smallest that the solver accepts, for comparison.
    pub const NONE: Self = Self::new("0", 0.0);

    /// All lengths that are measured.
    pub const ALL: [Self; 5] = [
        Self::new("2^-8", 1.0 / 256.0),
        Self::new("2^-10", 1.0 / 1024.0),
        Self::DEFAULT,
        Self::new("2^-14", 1.0 / 16384.0),
        Self::NONE,
    ];

    const fn new(name: &'static str, length: f64) -> Self {
        Self {
            name,
            length: Some(length),
        }
    }

    /// A scene with this memory length on every surface. A point, which has no size, keeps its own.
    pub fn of(self, scene: &SceneFile) -> SceneFile {
        let mut scene = scene.clone();
        let size = size(&scene.vertices);
        let length = self.length.map(|part| part * size);
        for surface in &mut scene.written.surfaces {
            surface.memory = length.filter(|_| size > 0.0).or(surface.memory);
        }
        scene
    }
}

fn size(vertices: &[[f64; 2]]) -> f64 {
    let pairs = vertices
        .iter()
        .flat_map(|a| vertices.iter().map(move |b| (a, b)));
    let distances = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    distances.fold(0.0, f64::max)
}

/// A setting of the solver and its scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Number type.
    pub number: Number,
    /// Evolution within a frame.
    pub evolution: Evolution,
    /// Memory length.
    pub memory: Memory,
}

impl Setting {
    /// The reference of every other setting of this memory length, at [`FINEST`].
    pub(super) const fn reference(memory: Memory) -> Self {
        Self {
            number: Number::F64,
            evolution: Evolution::Path,
            memory,
        }
    }

    /// All combinations.
    pub fn all() -> impl Iterator<Item = Self> {
        let pairs = Number::ALL
            .into_iter()
            .flat_map(move |number| Evolution::ALL.map(|evolution| (number, evolution)));
        pairs.flat_map(|(number, evolution)| {
            Memory::ALL.map(|memory| Self {
                number,
                evolution,
                memory,
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_scene::Source;

    #[test]
    fn a_memory_length_is_a_part_of_the_body_size() {
        let text = "[body]\nrectangle = [0.4, 0.3]\nstart = [0.0, 1.0, 0.0]\n[spring]\ntranslation = 1.0\nrotation = 1.0\n\
                    [[surface]]\nnormal = [0.0, 1.0]\noffset = 0.0\nstatic = 0.5\ndynamic = 0.3\n";
        let read =
            |text: &str| SceneFile::parse(Source::new("box.toml", text), 1e9).expect("a scene");
        let lengths =
            |text: &str| Memory::ALL.map(|memory| memory.of(&read(text)).surfaces[0].memory);
        let [longest, .., short, none] = lengths(text);
        assert_eq!(
            [longest, short, none],
            [Some(0.5 / 256.0), Some(0.5 / 16384.0), Some(0.0)]
        );
        assert_eq!(Memory::DEFAULT.of(&read(text)).surfaces[0].memory, None);
        let point = text.replace("rectangle = [0.4, 0.3]", "vertices = [[0.0, 0.0]]");
        assert_eq!(lengths(&point), [None; 5]);
    }
}
