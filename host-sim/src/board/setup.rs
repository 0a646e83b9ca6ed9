//! What a session begins with: the scene and the mode.

use std::sync::Arc;
use std::time::Duration;

use stiction_core::Evolution;
use stiction_core::frame::{
    Command, Mode, Parameters, Reason, SceneCommand, Stepping, Subject, frame_bytes, scene_bytes,
};
use stiction_scene::{SceneFile, SurfaceInfo};

use super::error::BoardError;
use super::heard::{About, Answer};
use super::refusal::explain;
use super::session::{Mail, Session};

/// The board tells so often how it fares (ms): as often as leaves a line of 115200 baud room for 100 whole steps a second, the
/// fewest that a board makes.
const HEALTH_EVERY: u16 = 350;

/// A mode that is too much for the line is made less so often.
const ATTEMPTS: usize = 8;

/// The scene and how the board is to work.
#[derive(Clone, Debug)]
pub(super) struct Setup {
    pub(super) scene: Arc<SceneFile>,
    pub(super) evolution: Evolution,
    /// Ticks per second (Hz), instead of those that the board has.
    pub(super) tick: Option<u16>,
    /// The board keeps the scene that it has.
    pub(super) keep: bool,
    /// A step with every sample, instead of with every tick.
    pub(super) per_sample: bool,
}

impl Setup {
    /// Sends both, asks the board how it works then, as its budget follows from its tick, and waits for the counts from which this
    /// session's are taken. A remark for the user, if there is one.
    pub(super) fn apply(
        &self,
        session: &mut Session,
        about: &mut About,
        mail: &mut Mail,
    ) -> Result<Option<String>, BoardError> {
        if !self.keep {
            self.send_scene(session, about, mail)?;
        }
        let remark = self.set_mode(session, mail, self.mode(about))?;
        *about = session.greet(mail)?;
        let patience = Duration::from_millis(2 * u64::from(HEALTH_EVERY));
        session.wait_for_health(mail, patience)?;
        Ok(remark)
    }

    /// The body at the start of this scene, or, where it is not to begin anew, what is another one than in `before`: the
    /// body stays where it is.
    pub(super) fn change(
        &self,
        before: &Self,
        anew: bool,
        session: &mut Session,
        (about, mail): (&About, &mut Mail),
    ) -> Result<(), BoardError> {
        if anew {
            self.send_scene(session, about, mail)?;
        } else if self.frictions() != before.frictions() || self.stiffness() != before.stiffness() {
            let names = self.surface_names();
            session.demand(mail, Command::Parameters(self.parameters()?), &names)?;
        }
        if self.evolution != before.evolution {
            self.set_mode(session, mail, self.mode(about))?;
        }
        Ok(())
    }

    fn stiffness(&self) -> [f64; 2] {
        let scene = &self.scene;
        [scene.stiffness_translation, scene.stiffness_rotation]
    }

    /// mu_s, mu_d and memory length of every surface.
    fn frictions(&self) -> Vec<([f64; 2], Option<f64>)> {
        let surfaces = self.scene.surfaces.iter();
        let friction = |surface: &SurfaceInfo| {
            let coefficients = [surface.friction_static, surface.friction_dynamic];
            (coefficients, surface.memory)
        };
        surfaces.map(friction).collect()
    }

    /// The parameters, which a board has for all surfaces together.
    fn parameters(&self) -> Result<Parameters, BoardError> {
        let frictions = self.frictions();
        let first = frictions.first().copied().unwrap_or_default();
        if frictions.iter().any(|&friction| friction != first) {
            let allowed = "the surfaces have frictions of their own, allowed on a board: the same static and dynamic one and the \
                           same memory length for all";
            return Err(BoardError::Refused(allowed.to_owned()));
        }
        let ([mu_s, mu_d], memory) = first;
        let [k_h, k_theta] = self.stiffness();
        Ok(Parameters {
            stiffness_translation: k_h as f32,
            stiffness_rotation: k_theta as f32,
            friction_static: mu_s as f32,
            friction_dynamic: mu_d as f32,
            memory: memory.map(|length| length as f32),
        })
    }

    fn send_scene(
        &self,
        session: &mut Session,
        about: &About,
        mail: &mut Mail,
    ) -> Result<(), BoardError> {
        let (vertices, surfaces) = (self.scene.vertices.len(), self.scene.surfaces.len());
        let bytes = frame_bytes(scene_bytes(vertices, surfaces));
        // Such a frame would be counted by the board and never answered.
        if bytes > usize::from(about.longest_frame) {
            return Err(BoardError::Refused(format!(
                "the scene has {vertices} vertices and {surfaces} surfaces, a frame of {bytes} bytes, allowed: {} vertices, \
                 {} surfaces, {} bytes",
                about.vertices, about.surfaces, about.longest_frame
            )));
        }
        let names = self.surface_names();
        self.scene.described(|description| {
            let scene = SceneCommand::from(description);
            session.demand(mail, Command::Scene(scene), &names)
        })
    }

    fn surface_names(&self) -> Vec<String> {
        let surfaces = self.scene.surfaces.iter();
        surfaces.map(|surface| surface.name.clone()).collect()
    }

    /// How the board is to work.
    pub(super) fn mode(&self, about: &About) -> Mode {
        Mode {
            evolution: self.evolution,
            stepping: match self.per_sample {
                true => Stepping::PerSample,
                false => Stepping::Timed,
            },
            plane: self.scene.hand.placement.axes,
            events: true,
            tick_rate: self.tick.unwrap_or(about.mode.tick_rate),
            pose_every: 1,
            forces_every: 1,
            health_every: HEALTH_EVERY,
        }
    }

    /// Where the line is too slow for a pose with forces at every tick: fewer of them, or, where every step is wanted,
    /// fewer ticks; which, is the remark.
    fn set_mode(
        &self,
        session: &mut Session,
        mail: &mut Mail,
        mut mode: Mode,
    ) -> Result<Option<String>, BoardError> {
        let mut remark = None;
        for _ in 0..ATTEMPTS {
            let Some(refusal) = session.order(mail, Command::Mode(mode))? else {
                return Ok(remark);
            };
            match less(&mode, &refusal) {
                Some(smaller) => mode = smaller,
                None => return Err(BoardError::Refused(explain("mode", &refusal, &[]))),
            }
            remark = Some(match mode.stepping {
                Stepping::PerSample => {
                    format!("the line carries {} steps a second", mode.tick_rate)
                }
                Stepping::Timed => {
                    format!(
                        "the line carries a pose with forces at every {} ticks",
                        mode.pose_every
                    )
                }
            });
        }
        session.demand(mail, Command::Mode(mode), &[])?;
        Ok(remark)
    }
}

/// A mode that is less for the line, where one was refused for that.
fn less(mode: &Mode, refusal: &Answer) -> Option<Mode> {
    let too_much = f64::from(refusal.value / refusal.limit);
    let of_line = refusal.subject == Subject::LineRate && refusal.reason == Reason::Unsupported;
    if !of_line || !(1.0..1e4).contains(&too_much) {
        return None;
    }
    Some(if mode.stepping == Stepping::PerSample {
        // A part of the load, the health, does not become less with the ticks.
        let fitting = (f64::from(mode.tick_rate) / too_much).floor() as u16;
        let tick_rate = fitting.min(mode.tick_rate.saturating_sub(1)).max(1);
        Mode { tick_rate, ..*mode }
    } else {
        let fitting = (f64::from(mode.pose_every) * too_much).ceil() as u16;
        let every = fitting.max(mode.pose_every.saturating_add(1));
        Mode {
            pose_every: every,
            forces_every: every,
            ..*mode
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_core::frame::Reference;

    fn refusal(subject: Subject, value: f32, limit: f32) -> Answer {
        Answer {
            command: Reference::default(),
            reason: Reason::Unsupported,
            subject,
            value,
            limit,
            allowed: String::new(),
        }
    }

    #[test]
    fn a_slow_line_gets_fewer_poses_or_fewer_steps() {
        let timed = Mode {
            pose_every: 1,
            forces_every: 1,
            ..Mode::default()
        };
        let refused = refusal(Subject::LineRate, 256_000.0, 92_160.0);
        let mode = less(&timed, &refused).expect("a slower mode");
        assert_eq!(
            (mode.tick_rate, mode.pose_every, mode.forces_every),
            (1000, 3, 3)
        );
        let per_sample = Mode {
            stepping: Stepping::PerSample,
            ..timed
        };
        let mode = less(&per_sample, &refused).expect("a slower mode");
        assert_eq!(
            (mode.tick_rate, mode.pose_every, mode.forces_every),
            (360, 1, 1)
        );
    }

    #[test]
    fn what_is_refused_by_little_becomes_less_all_the_same() {
        let refused = refusal(Subject::LineRate, 11_521.0, 11_520.0);
        let mode = Mode {
            pose_every: 2,
            forces_every: 2,
            ..Mode::default()
        };
        assert_eq!(less(&mode, &refused).map(|mode| mode.forces_every), Some(3));
        let mode = Mode {
            stepping: Stepping::PerSample,
            tick_rate: 70,
            ..mode
        };
        assert_eq!(less(&mode, &refused).map(|mode| mode.tick_rate), Some(69));
    }

    #[test]
    fn another_refusal_is_one() {
        for refused in [
            refusal(Subject::TickRate, 5000.0, 1000.0),
            refusal(Subject::LineRate, 256_000.0, f32::NAN),
            refusal(Subject::LineRate, 256_000.0, 0.0),
        ] {
            assert!(less(&Mode::default(), &refused).is_none(), "{refused:?}");
        }
    }
}
