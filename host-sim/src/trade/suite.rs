//! The scenes that are measured: the bundled ones, random ones, and a box in a hand that moves freely.

use std::fmt;
use std::path::Path;

use stiction_scene::{HandPath, InputError, Motion, SceneFile, Source};

use super::setting::{FINEST, Memory};
use super::{hand, random};
use stiction_live::number::Number;
use stiction_live::scenes;

/// The part of the suite to which a scene belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// The scenes of the program, including the paper's and the dragged boxes.
    Bundled,
    /// Random scenes.
    Random,
    /// The box in a hand.
    Hand,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 3] = [Self::Bundled, Self::Random, Self::Hand];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bundled => "bundled",
            Self::Random => "random",
            Self::Hand => "hand",
        }
    }
}

/// A scene and the hand's motion through it.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its group.
    pub group: Group,
    /// The scene.
    pub scene: SceneFile,
    /// The hand.
    pub path: HandPath,
}

impl Case {
    fn new(group: Group, name: String, text: &str) -> Result<Self, InputError> {
        // The limits of f32 are those of the narrowest number type.
        let scene = SceneFile::parse(Source::new(name, text), Number::F32.limit())?;
        match &scene.hand.motion {
            Some(Motion::Keyframes(path)) => Ok(Self {
                group,
                path: path.clone(),
                scene,
            }),
            _ => Err(scene.source().error("[hand] has no `keyframes`")),
        }
    }

    /// This case with a memory length on all surfaces.
    pub(super) fn with(&self, memory: Memory) -> Self {
        Self {
            scene: memory.of(&self.scene),
            ..self.clone()
        }
    }

    /// Frames at the finest rate.
    pub fn frame_count(&self) -> usize {
        self.path.frame_count(Some(FINEST))
    }
}

/// Random drags of ordinary use, without end: bodies of 2 to 6 vertices within 0.1 m, 1 to 3 surfaces, a few seconds each.
pub fn drags() -> impl Iterator<Item = Result<Case, InputError>> {
    let mut random = random::Random::new(1);
    (0..).map(move |i| {
        let (name, text) = (format!("random-{i}.toml"), random::scene(&mut random));
        Case::new(Group::Random, name, &text)
    })
}

/// The scenes, and remarks about them.
#[derive(Clone, Debug)]
pub struct Suite {
    /// All scenes.
    pub cases: Vec<Case>,
    /// The motion of the hand in the last one.
    hand: String,
}

/// The bundled scenes, the number of random ones, the time for which the hand moves (s).
struct Extent {
    bundled: fn(&str) -> bool,
    random: usize,
    seconds: f64,
}

const WHOLE: Extent = Extent {
    // The scene that the page opens with is the flat box, only with longer slips.
    bundled: |name| name != "drag",
    random: 200,
    seconds: 30.0,
};
const QUICK: Extent = Extent {
    // Slips of one length, and slips as short as the memory length permits.
    bundled: |name| matches!(name, "vertex-stick-slip" | "burst"),
    random: 4,
    seconds: 2.0,
};

impl Suite {
    /// Creates the suite with a recorded path of the hand, or a synthetic one; `quick`: a few scenes of each kind.
    ///
    /// # Errors
    /// Fails if the recorded path cannot be used.
    pub fn new(recorded: Option<&Path>, quick: bool) -> Result<Self, InputError> {
        let extent = if quick { QUICK } else { WHOLE };
        let mut cases = Vec::new();
        for (name, text) in scenes::without_obstacles().filter(|(name, _)| (extent.bundled)(name)) {
            cases.push(Case::new(Group::Bundled, format!("{name}.toml"), text)?);
        }
        for drag in drags().take(extent.random) {
            cases.push(drag?);
        }
        let (path, hand) = match recorded {
            None => (
                hand::synthetic(extent.seconds),
                "a synthetic hand".to_owned(),
            ),
            Some(file) => {
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                (
                    hand::recorded(file)?,
                    format!("a recorded hand ({name}, scaled to 0.12 m)"),
                )
            }
        };
        cases.push(Case {
            group: Group::Hand,
            scene: hand::scene()?,
            path,
        });
        Ok(Self { cases, hand })
    }

    /// Frames at the finest rate.
    pub fn frame_count(&self) -> usize {
        self.cases.iter().map(Case::frame_count).sum()
    }

    fn seconds(&self, group: Group) -> f64 {
        let cases = self.cases.iter().filter(|case| case.group == group);
        cases
            .map(|case| (case.frame_count() - 1) as f64)
            .sum::<f64>()
            / FINEST
    }
}

impl fmt::Display for Suite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = |group| self.cases.iter().filter(|case| case.group == group).count();
        write!(
            f,
            "{} bundled scenes ({:.0} s of motion, the dragged boxes among them), {} random ones ({} s each; bodies of 2 to 6 \
             vertices within 0.1 m, 1 to 3 surfaces), and a box of 0.10 m × 0.06 m in the corner of floor and wall, in {} \
             ({:.0} s)",
            count(Group::Bundled),
            self.seconds(Group::Bundled),
            count(Group::Random),
            random::LEGS,
            self.hand,
            self.seconds(Group::Hand),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread;
    use stiction_core::{Evolution, Fixed, Real, SiFloat, Status};
    use stiction_live::simulate::Running;
    use stiction_tests::expect::times;

    #[test]
    fn every_number_type_carries_every_scene() {
        for case in Suite::new(None, false).expect("a suite").cases {
            for refused in [
                case.scene.scene::<f64>().err(),
                case.scene.scene::<f32>().err(),
                case.scene.scene::<Fixed>().err(),
            ] {
                assert_eq!(refused, None);
            }
        }
    }

    /// Drags in which the body does not come to rest, by number type and evolution: in all, two contacts neither bear the load nor slide, and
    /// what follows goes round or on for more than 64 rounds; in the others, rounding leads there.
    const AMBIGUOUS: [(&str, Evolution, &[usize]); 6] = [
        ("f64", Evolution::Path, &[2055, 6928, 8969]),
        ("f64", Evolution::Frame, &[2055, 6928, 8969]),
        ("f32", Evolution::Path, &[2055, 4532, 5717, 6928, 8969]),
        ("f32", Evolution::Frame, &[2055, 5717, 6928, 8969]),
        ("fixed", Evolution::Path, &[2055, 3276, 5717, 6928, 8969]),
        ("fixed", Evolution::Frame, &[2055, 5717, 6928, 8969]),
    ];

    /// The drags of which a frame ends out of balance, or in a limit.
    fn odd<R: Real<Si: SiFloat>>(drags: &[Case], evolution: Evolution) -> Vec<usize> {
        let is_odd = |case: &Case| {
            let mut running = Running::<R>::of(&case.scene, evolution, u32::MAX).expect("a scene");
            let mut frames = case.path.frames(Some(FINEST));
            frames.any(|hand| !matches!(running.frame(&hand).status, Status::Ok | Status::Jammed))
        };
        (0..drags.len()).filter(|&i| is_odd(&drags[i])).collect()
    }

    #[test]
    fn every_frame_of_a_random_drag_ends_in_balance() {
        let drags: Vec<_> = drags()
            .take(times(500, 10_000))
            .map(|case| case.expect("a drag"))
            .collect();
        let run = |(name, evolution, known): (&str, Evolution, &[usize])| {
            let odd = match name {
                "f64" => odd::<f64>(&drags, evolution),
                "f32" => odd::<f32>(&drags, evolution),
                _ => odd::<Fixed>(&drags, evolution),
            };
            let known: Vec<_> = known.iter().copied().filter(|&i| i < drags.len()).collect();
            assert_eq!(odd, known, "{name} {evolution:?}");
        };
        thread::scope(|scope| {
            for kind in AMBIGUOUS {
                scope.spawn(move || run(kind));
            }
        });
    }
}
