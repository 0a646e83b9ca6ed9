//! The settings at the beginning of a session: the scene and the mode.

use std::sync::Arc;
use std::time::Duration;

use stiction_core::{Description, Evolution, Fixed};
use stiction_firmware::station::SLOWEST_TICK;
use stiction_scene::{Indices, ObstacleInfo, SceneFile, SurfaceInfo};
use stiction_wire::{
    Command, Mode, NumberType, Parameters, Reason, SceneCommand, Stepping, Subject, frame_bytes,
    scene_bytes,
};

use super::error::BoardError;
use super::message::{About, Answer};
use super::refusal::explain;
use super::session::{Inbox, Session};
use stiction_live::record::Names;

/// Interval of the board's health reports (ms): it leaves a line of 115200 baud room for 100 whole steps per second, the fewest
/// that a board makes.
const HEALTH_EVERY: u16 = 350;

/// Number of attempts to reduce a mode that is too much for the line.
const ATTEMPTS: usize = 8;

#[derive(Clone, Debug)]
pub(super) struct Setup {
    pub(super) scene: Arc<SceneFile>,
    pub(super) evolution: Evolution,
    /// Ticks per second (Hz), instead of the board's own.
    pub(super) tick: Option<u16>,
    /// The board keeps its present scene.
    pub(super) keep: bool,
    /// A step with every sample, instead of with every tick.
    pub(super) per_sample: bool,
}

impl Setup {
    /// Sends both, requests the board's description, as its budget depends on its tick, and waits for the counts at which those
    /// of this session start. Returns a remark for the user, if there is one.
    pub(super) fn apply(
        &self,
        session: &mut Session,
        about: &mut About,
        inbox: &mut Inbox,
    ) -> Result<Option<String>, BoardError> {
        if !self.keep {
            self.send_scene(session, about, inbox)?;
        }
        let remark = self.set_mode(session, inbox, self.mode(about))?;
        *about = session.greet(inbox)?;
        let patience = Duration::from_millis(2 * u64::from(HEALTH_EVERY));
        session.wait_for_health(inbox, patience)?;
        Ok(remark)
    }

    /// Sends the parameters in which this scene differs from the one `before`: the body stays where it is.
    pub(super) fn send_parameters(
        &self,
        before: &Self,
        session: &mut Session,
        inbox: &mut Inbox,
    ) -> Result<(), BoardError> {
        if self.frictions() != before.frictions() || self.stiffness() != before.stiffness() {
            let names = self.names();
            session.demand(inbox, Command::Parameters(self.parameters()?), &names)?;
        }
        Ok(())
    }

    /// Sends the evolution if it differs from the one `before`.
    pub(super) fn send_evolution(
        &self,
        before: &Self,
        session: &mut Session,
        about: &About,
        inbox: &mut Inbox,
    ) -> Result<(), BoardError> {
        if self.evolution != before.evolution {
            self.set_mode(session, inbox, self.mode(about))?;
        }
        Ok(())
    }

    fn stiffness(&self) -> [f64; 2] {
        let scene = &self.scene;
        [scene.stiffness_translation, scene.stiffness_rotation]
    }

    /// mu_s, mu_d and memory length of every surface and obstacle.
    fn frictions(&self) -> Vec<([f64; 2], Option<f64>)> {
        let of_surface = |s: &SurfaceInfo| ([s.friction_static, s.friction_dynamic], s.memory);
        let of_obstacle = |o: &ObstacleInfo| ([o.friction_static, o.friction_dynamic], o.memory);
        let surfaces = self.scene.surfaces.iter().map(of_surface);
        let obstacles = self.scene.obstacles.iter().map(of_obstacle);
        surfaces.chain(obstacles).collect()
    }

    /// The parameters, which a board has for all surfaces together.
    fn parameters(&self) -> Result<Parameters, BoardError> {
        let frictions = self.frictions();
        let first = frictions.first().copied().unwrap_or_default();
        if frictions.iter().any(|&friction| friction != first) {
            let allowed = "the surfaces and obstacles have frictions of their own, allowed on a board: the same static and dynamic one and the \
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

    /// Places the body at the start of this scene.
    pub(super) fn send_scene(
        &self,
        session: &mut Session,
        about: &About,
        inbox: &mut Inbox,
    ) -> Result<(), BoardError> {
        let names = self.names_on(about);
        let (sent, _) = self.described_on(about, |description| {
            let obstacles = description.obstacles;
            let corners = obstacles.iter().map(|obstacle| obstacle.vertices.len());
            let corners = corners.sum();
            if corners > usize::from(about.corners) {
                return Err(BoardError::Refused(too_many(
                    about,
                    obstacles.len(),
                    corners,
                )));
            }
            let counts = [
                description.vertices.len(),
                description.surfaces.len(),
                obstacles.len(),
                corners,
            ];
            check_frame(about, counts)?;
            let scene = SceneCommand::from(description);
            session.demand(inbox, Command::Scene(scene), &names)
        });
        sent
    }

    /// The scene in the board's number type.
    fn described_on<T>(
        &self,
        about: &About,
        take: impl FnOnce(&Description<'_, f32>) -> T,
    ) -> (T, Option<Indices>) {
        match about.number {
            NumberType::F32 => self.scene.described::<f32, T>(take),
            NumberType::Fixed => self.scene.described::<Fixed, T>(take),
        }
    }

    /// The indices of the board's obstacles in the scene file, if they differ.
    pub(super) fn indices(&self, about: &About) -> Option<Indices> {
        self.described_on(about, |_| ()).1
    }

    fn names(&self) -> Names {
        Names::of(&self.scene.surfaces, &self.scene.obstacles)
    }

    /// The names of surfaces, and of obstacles at their indices on the board.
    fn names_on(&self, about: &About) -> Names {
        let mut names = self.names();
        if let Some(indices) = self.indices(about) {
            let name = |i: usize| names.obstacles.get(indices.obstacle(i)?).cloned();
            names.obstacles = (0..).map_while(name).collect();
        }
        names
    }

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

    /// If the line is too slow for a pose with forces at every tick: fewer of them, or, if every step is needed, fewer ticks, and then fewer
    /// forces; the remark reports which.
    fn set_mode(
        &self,
        session: &mut Session,
        inbox: &mut Inbox,
        mut mode: Mode,
    ) -> Result<Option<String>, BoardError> {
        let mut remark = None;
        for _ in 0..ATTEMPTS {
            let Some(refusal) = session.order(inbox, Command::Mode(mode))? else {
                return Ok(remark);
            };
            match less(&mode, &refusal) {
                Some(smaller) => mode = smaller,
                None => {
                    return Err(BoardError::Refused(explain(
                        "mode",
                        &refusal,
                        &Names::default(),
                    )));
                }
            }
            remark = Some(match mode.stepping {
                Stepping::PerSample => {
                    let steps = format!("the line carries {} steps a second", mode.tick_rate);
                    match mode.forces_every {
                        1 => steps,
                        every => format!("{steps}, and the forces of one in {every}"),
                    }
                }
                Stepping::Timed => {
                    format!(
                        "the line carries a pose with forces at every {} ticks",
                        mode.pose_every
                    )
                }
            });
        }
        session.demand(inbox, Command::Mode(mode), &Names::default())?;
        Ok(remark)
    }
}

/// The board would count a longer frame and never answer it.
fn check_frame(about: &About, counts: [usize; 4]) -> Result<(), BoardError> {
    let bytes = frame_bytes(scene_bytes(counts));
    if bytes <= usize::from(about.longest_frame) {
        return Ok(());
    }
    let shown = |[vertices, surfaces]: [usize; 2], corners: String| {
        format!("{vertices} vertices, {surfaces} surfaces{corners}")
    };
    let [vertices, surfaces, obstacles, corners] = counts;
    let scene = shown(
        [vertices, surfaces],
        match obstacles {
            0 => String::new(),
            count => format!(", {count} obstacles with {corners} corners"),
        },
    );
    let board = shown(
        [about.vertices, about.surfaces].map(usize::from),
        match about.corners {
            0 => String::new(),
            count => format!(", obstacles with {count} corners"),
        },
    );
    Err(BoardError::Refused(format!(
        "the scene has {scene}, a frame of {bytes} bytes, allowed: {board}, {} bytes",
        about.longest_frame
    )))
}

/// The message that there is no room for so many corners, or for any obstacle.
fn too_many(about: &About, obstacles: usize, corners: usize) -> String {
    let scene = format!("the scene has {obstacles} obstacles with {corners} corners");
    match about.corners {
        0 => format!("{scene}, allowed on this board: those of a scene that is compiled in"),
        most => format!("{scene}, allowed on this board: {most} corners in all"),
    }
}

/// A mode that needs less of the line, if one was refused for that reason.
fn less(mode: &Mode, refusal: &Answer) -> Option<Mode> {
    let too_much = f64::from(refusal.value / refusal.limit);
    let of_line = refusal.subject == Subject::LineRate && refusal.reason == Reason::Unsupported;
    if !of_line || !(1.0..1e4).contains(&too_much) {
        return None;
    }
    Some(if mode.stepping == Stepping::PerSample {
        // A part of the load, the health reports, does not decrease with the ticks.
        let fitting = (f64::from(mode.tick_rate) / too_much).floor() as u16;
        let tick_rate = fitting.min(mode.tick_rate.saturating_sub(1));
        // No board makes fewer steps than this.
        match tick_rate < SLOWEST_TICK {
            false => Mode { tick_rate, ..*mode },
            true => Mode {
                tick_rate: SLOWEST_TICK,
                forces_every: mode.forces_every.saturating_add(1),
                ..*mode
            },
        }
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
    use stiction_wire::Reference;

    /// What of ticks and of every how many poses and forces a mode is left after a refusal of this value, with this limit.
    fn left(mode: Mode, (subject, value, limit): (Subject, f32, f32)) -> Option<(u16, u16, u16)> {
        let refusal = Answer {
            command: Reference::default(),
            reason: Reason::Unsupported,
            subject,
            value,
            limit,
            allowed: String::new(),
        };
        let mode = less(&mode, &refusal)?;
        Some((mode.tick_rate, mode.pose_every, mode.forces_every))
    }

    #[test]
    fn a_slow_line_gets_fewer_poses_or_fewer_steps() {
        let timed = |every: u16| Mode {
            pose_every: every,
            forces_every: every,
            ..Mode::default()
        };
        let per_sample = |tick_rate: u16| Mode {
            stepping: Stepping::PerSample,
            tick_rate,
            ..timed(1)
        };
        let much = (Subject::LineRate, 256_000.0, 92_160.0);
        let little = (Subject::LineRate, 11_521.0, 11_520.0);
        for (mode, refusal, expected) in [
            (timed(1), much, Some((1000, 3, 3))),
            (per_sample(1000), much, Some((360, 1, 1))),
            (per_sample(200), much, Some((100, 1, 2))),
            (timed(2), little, Some((1000, 3, 3))),
            (per_sample(170), little, Some((169, 1, 1))),
            // Another refusal is one.
            (timed(1), (Subject::TickRate, 5000.0, 1000.0), None),
            (timed(1), (Subject::LineRate, 256_000.0, f32::NAN), None),
            (timed(1), (Subject::LineRate, 256_000.0, 0.0), None),
        ] {
            assert_eq!(left(mode, refusal), expected, "{mode:?} {refusal:?}");
        }
    }
}
