//! What a session begins with: the scene and the mode.

use std::time::Duration;

use stiction_core::Evolution;
use stiction_core::frame::{
    Command, Mode, Reason, SceneCommand, Stepping, Subject, frame_bytes, scene_bytes,
};

use super::error::BoardError;
use super::heard::{About, Answer};
use super::refusal::explain;
use super::session::{Mail, Session};
use crate::scene_file::SceneFile;

/// The board tells so often how it fares (ms).
const HEALTH_EVERY: u16 = 250;

/// The scene and how the board is to work.
#[derive(Clone, Debug)]
pub(super) struct Setup<'a> {
    pub(super) scene: &'a SceneFile,
    pub(super) evolution: Evolution,
    /// Of the solver (rad).
    pub(super) tolerance: f32,
    /// Ticks per second (Hz), instead of those that the board has.
    pub(super) tick: Option<u16>,
    /// The board keeps the scene that it has.
    pub(super) keep: bool,
    /// A step with every sample, instead of with every tick.
    pub(super) per_sample: bool,
}

impl Setup<'_> {
    /// Sends both and waits for the counts from which this session's are taken. A remark for the user, if there is one.
    pub(super) fn apply(
        &self,
        session: &mut Session,
        about: &About,
        mail: &mut Mail,
    ) -> Result<Option<String>, BoardError> {
        if !self.keep {
            self.send_scene(session, about, mail)?;
        }
        let mode = self.mode(about);
        let remark = match session.order(mail, Command::Mode(mode))? {
            None => None,
            Some(refusal) => Some(self.send_less(session, mail, mode, &refusal)?),
        };
        let patience = Duration::from_millis(2 * u64::from(HEALTH_EVERY));
        session.wait_for_health(mail, patience)?;
        Ok(remark)
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

    fn mode(&self, about: &About) -> Mode {
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
            tolerance: self.tolerance,
        }
    }

    /// The line is too slow for a pose with forces at every tick: fewer of them, or, where every step is wanted, fewer
    /// ticks.
    fn send_less(
        &self,
        session: &mut Session,
        mail: &mut Mail,
        mode: Mode,
        refusal: &Answer,
    ) -> Result<String, BoardError> {
        match less(&mode, refusal) {
            Some((mode, remark)) => {
                session.demand(mail, Command::Mode(mode), &[])?;
                Ok(remark)
            }
            None => Err(BoardError::Refused(explain("mode", refusal, &[]))),
        }
    }
}

/// The mode that a line carries, and what it means, where another one was refused for the load of the line.
fn less(mode: &Mode, refusal: &Answer) -> Option<(Mode, String)> {
    let too_much = f64::from(refusal.value / refusal.limit);
    let of_line = refusal.subject == Subject::LineRate && refusal.reason == Reason::Unsupported;
    if !of_line || !(1.0..1e4).contains(&too_much) {
        return None;
    }
    Some(if mode.stepping == Stepping::PerSample {
        let tick_rate = (f64::from(mode.tick_rate) / too_much).floor().max(1.0) as u16;
        let mode = Mode { tick_rate, ..*mode };
        (mode, format!("the line carries {tick_rate} steps a second"))
    } else {
        let every = too_much.ceil() as u16;
        let remark = format!("the line carries a pose with forces at every {every} ticks");
        let mode = Mode {
            pose_every: every,
            forces_every: every,
            ..*mode
        };
        (mode, remark)
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
        let (mode, _) = less(&timed, &refused).expect("a slower mode");
        assert_eq!(
            (mode.tick_rate, mode.pose_every, mode.forces_every),
            (1000, 3, 3)
        );
        let per_sample = Mode {
            stepping: Stepping::PerSample,
            ..timed
        };
        let (mode, _) = less(&per_sample, &refused).expect("a slower mode");
        assert_eq!(
            (mode.tick_rate, mode.pose_every, mode.forces_every),
            (360, 1, 1)
        );
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
