//! Describes in words what a board refuses.

use stiction_core::Parameter;
use stiction_wire::{KnobNumber, Reason, Subject};

use super::message::Answer;
use stiction_live::record::Names;

/// What was refused, its value, the allowed values, and the nearest allowed value, or the bound that the value must stay below.
pub(super) fn explain(command: &str, answer: &Answer, names: &Names) -> String {
    let mut text = format!("the board refuses the {command}");
    let subject = subject(answer.subject, names);
    let unit = unit(answer.subject);
    match (&subject, answer.reason) {
        (None, reason) => {
            text.push_str(": ");
            text.push_str(meaning(reason));
        }
        (Some(subject), reason) => {
            text.push_str(&format!(": {subject} is {:?}{unit}", answer.value));
            if reason != Reason::Number {
                text.push_str(", ");
                text.push_str(meaning(reason));
            }
        }
    }
    if !answer.allowed.is_empty() {
        text.push_str(&format!(", allowed: {}", answer.allowed));
    }
    if !answer.limit.is_nan() && subject.is_some() {
        let limit = if answer.reason == Reason::NotPassive {
            "the limit"
        } else {
            "the nearest"
        };
        text.push_str(&format!(", {limit}: {:?}{unit}", answer.limit));
    }
    text
}

const fn meaning(reason: Reason) -> &'static str {
    match reason {
        Reason::Done => "it is done",
        Reason::Version => "it speaks another version of the wire format",
        Reason::UnknownType => "it does not know this command",
        Reason::Length => "its length is not that of this command",
        Reason::Code => "it holds a code without a meaning",
        Reason::Number => "a number is not allowed",
        Reason::NotPassive => "the haptic device would not be passive",
        Reason::Unsupported => "the board has no time, no room or no use for it",
        Reason::NotNow => "not now: it is stopped by a fault, or another command is under way",
    }
}

fn subject(subject: Subject, names: &Names) -> Option<String> {
    let parameter = match subject {
        Subject::Command => return None,
        Subject::TickRate => return Some("the tick rate".to_owned()),
        Subject::LineRate => return Some("the load of the line".to_owned()),
        Subject::Knob(number) => {
            let number = number.name().replace('-', " ");
            return Some(format!("the {number} of the knob"));
        }
        Subject::Scene(parameter) => parameter,
    };
    let name = match parameter {
        Parameter::Normal(i)
        | Parameter::Offset(i)
        | Parameter::FrictionStatic(i)
        | Parameter::FrictionDynamic(i)
        | Parameter::Memory(i)
        | Parameter::Penetration { surface: i, .. } => names.surfaces.get(i),
        Parameter::Corners(i)
        | Parameter::Corner { obstacle: i, .. }
        | Parameter::Side { obstacle: i, .. }
        | Parameter::ObstacleFrictionStatic(i)
        | Parameter::ObstacleFrictionDynamic(i)
        | Parameter::ObstacleMemory(i)
        | Parameter::Overlap(i) => names.obstacles.get(i),
        Parameter::VertexCount
        | Parameter::Vertex(_)
        | Parameter::Start
        | Parameter::Weight
        | Parameter::HoldingPoint
        | Parameter::Reach
        | Parameter::StiffnessTranslation
        | Parameter::StiffnessRotation
        | Parameter::SurfaceCount
        | Parameter::ObstacleCount
        | Parameter::CornerCount => None,
    };
    Some(match name {
        Some(name) => format!("the {parameter} ({name:?})"),
        None => format!("the {parameter}"),
    })
}

pub(super) const fn unit(subject: Subject) -> &'static str {
    match subject {
        Subject::Command => "",
        Subject::TickRate => " Hz",
        Subject::LineRate => " bytes per second",
        Subject::Knob(number) => match number {
            KnobNumber::Origin | KnobNumber::Radius => " m",
            KnobNumber::CountsPerTurn => "",
            KnobNumber::TorqueConstant => " N·m/A",
            KnobNumber::FullCurrent => " A",
            KnobNumber::TorqueLimit => " N·m",
            KnobNumber::Damping => " N·m·s/rad",
        },
        Subject::Scene(parameter) => match parameter {
            Parameter::Weight => " N",
            Parameter::Reach
            | Parameter::Offset(_)
            | Parameter::HoldingPoint
            | Parameter::Vertex(_)
            | Parameter::Memory(_)
            | Parameter::Penetration { .. }
            | Parameter::Corner { .. }
            | Parameter::Side { .. }
            | Parameter::ObstacleMemory(_)
            | Parameter::Overlap(_) => " m",
            Parameter::StiffnessTranslation => " N/m",
            Parameter::StiffnessRotation => " N·m/rad",
            Parameter::VertexCount
            | Parameter::Start
            | Parameter::SurfaceCount
            | Parameter::Normal(_)
            | Parameter::FrictionStatic(_)
            | Parameter::FrictionDynamic(_)
            | Parameter::ObstacleCount
            | Parameter::CornerCount
            | Parameter::Corners(_)
            | Parameter::ObstacleFrictionStatic(_)
            | Parameter::ObstacleFrictionDynamic(_) => "",
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiction_wire::Reference;

    /// What the board says, its command, and all that is made of it, but for the beginning.
    #[test]
    fn a_refusal_has_the_value_its_unit_what_is_allowed_and_the_nearest() {
        let names = Names {
            surfaces: vec!["floor".to_owned(), "wall".to_owned()],
            obstacles: vec!["table".to_owned(), "post".to_owned()],
        };
        let nothing = f32::NAN;
        let of = Subject::Scene;
        let tick = (Subject::TickRate, 5000.0, 1000.0, "1 to 1000");
        let spring = (
            of(Parameter::StiffnessTranslation),
            900.0,
            800.0,
            "0, or less than the limit",
        );
        let friction = (
            of(Parameter::FrictionDynamic(1)),
            -0.5,
            nothing,
            "0 or more",
        );
        let sunk = (of(Parameter::Overlap(1)), 0.25, nothing, "at most 1e-5");
        let many = (of(Parameter::CornerCount), 17.0, 16.0, "0 to 16");
        let whole = (Subject::Command, 0.0, nothing, "");
        let torque = (
            Subject::Knob(KnobNumber::TorqueLimit),
            0.25,
            0.125,
            "at most that at full duty",
        );
        for (command, reason, (subject, value, limit, allowed), expected) in [
            (
                "mode",
                Reason::Unsupported,
                tick,
                "the tick rate is 5000.0 Hz, the board has no time, no room or no use for it, allowed: 1 to 1000, the nearest: 1000.0 Hz",
            ),
            (
                "parameters",
                Reason::NotPassive,
                spring,
                "the translational stiffness k_h is 900.0 N/m, the haptic device would not be passive, allowed: 0, or less than the limit, \
                 the limit: 800.0 N/m",
            ),
            (
                "scene",
                Reason::Number,
                friction,
                "the dynamic friction of surface 1 (\"wall\") is -0.5, allowed: 0 or more",
            ),
            (
                "scene",
                Reason::Number,
                sunk,
                "the depth of the body in obstacle 1 at the start (\"post\") is 0.25 m, allowed: at most 1e-5",
            ),
            (
                "scene",
                Reason::Unsupported,
                many,
                "the number of corners of all obstacles is 17.0, the board has no time, no room or no use for it, allowed: 0 to 16, the \
                 nearest: 16.0",
            ),
            (
                "knob",
                Reason::Number,
                torque,
                "the torque limit of the knob is 0.25 N·m, allowed: at most that at full duty, the nearest: 0.125 N·m",
            ),
            (
                "scene",
                Reason::NotNow,
                whole,
                "not now: it is stopped by a fault, or another command is under way",
            ),
        ] {
            let answer = Answer {
                command: Reference::default(),
                reason,
                subject,
                value,
                limit,
                allowed: allowed.to_owned(),
            };
            let expected = format!("the board refuses the {command}: {expected}");
            assert_eq!(explain(command, &answer, &names), expected);
        }
    }
}
