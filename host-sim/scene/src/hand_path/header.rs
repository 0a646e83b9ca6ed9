//! The header of a recorded path: which column is which number, in which unit. Columns may be in any order, have the names that other
//! programs give them, and state their units; columns that a path does not have are skipped.

use super::placement::AngleUnit;
use crate::source::excerpt;

/// The numbers of a record, by their own names.
pub(super) const NAMES: [&str; 10] = ["t", "x", "y", "z", "phi", "qx", "qy", "qz", "qw", "held"];
pub(super) const T: usize = 0;
pub(super) const X: usize = 1;
pub(super) const Z: usize = 3;
pub(super) const PHI: usize = 4;
pub(super) const QX: usize = 5;
pub(super) const QW: usize = 8;
pub(super) const HELD: usize = 9;

/// The numbers that a planar path needs, and those of one with six degrees of freedom.
const PLANAR: [usize; 4] = [T, X, X + 1, PHI];
const SPATIAL: [usize; 8] = [T, X, X + 1, Z, QX, QX + 1, QX + 2, QW];

/// Words before the axis in the name of a position or of a quaternion.
const POSITION: [&str; 6] = ["p", "pos", "position", "t", "trans", "translation"];
const QUATERNION: [&str; 6] = ["q", "quat", "quaternion", "rot", "rotation", "orientation"];
const TIME: [&str; 6] = ["t", "time", "timestamp", "stamp", "sec", "seconds"];

/// Units of time and of length, and how many of them make a second or a metre.
const UNITS_OF_TIME: [(&str, f64); 8] = [
    ("s", 1.0),
    ("sec", 1.0),
    ("seconds", 1.0),
    ("ms", 1e3),
    ("us", 1e6),
    ("µs", 1e6),
    ("ns", 1e9),
    ("nsec", 1e9),
];
const UNITS_OF_LENGTH: [(&str, f64); 4] = [("m", 1.0), ("meters", 1.0), ("cm", 1e2), ("mm", 1e3)];
const UNITS_OF_ANGLE: [(&str, AngleUnit); 5] = [
    ("rad", AngleUnit::Radians),
    ("radians", AngleUnit::Radians),
    ("deg", AngleUnit::Degrees),
    ("degrees", AngleUnit::Degrees),
    ("°", AngleUnit::Degrees),
];

/// The columns of a file.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    /// The place of each number in a row, as in [`NAMES`].
    places: [Option<usize>; NAMES.len()],
    /// How many of a column's units make a second or a metre; `None` if the header does not say it.
    per_unit: [Option<f64>; NAMES.len()],
    /// The unit of phi, if the header has it.
    pub(super) angle: Option<AngleUnit>,
    /// The names of all columns.
    pub(super) names: Vec<String>,
    /// The names of the columns that are skipped.
    pub(super) skipped: Vec<String>,
}

impl Columns {
    /// The columns of the TUM format, which needs no header.
    pub(super) fn tum() -> Self {
        let mut places = [None; NAMES.len()];
        for (place, number) in SPATIAL.into_iter().enumerate() {
            places[number] = Some(place);
        }
        Self {
            places,
            per_unit: [None; NAMES.len()],
            angle: None,
            names: SPATIAL.map(|number| NAMES[number].to_owned()).to_vec(),
            skipped: Vec::new(),
        }
    }

    /// The columns that a header names.
    ///
    /// # Errors
    /// What it lacks or has twice.
    pub(super) fn of(header: &[String]) -> Result<Self, String> {
        let mut columns = Self {
            places: [None; NAMES.len()],
            per_unit: [None; NAMES.len()],
            angle: None,
            names: header.to_vec(),
            skipped: Vec::new(),
        };
        for (place, name) in header.iter().enumerate() {
            let column = Column::of(name);
            let Some(number) = column.number() else {
                columns.skipped.push(name.clone());
                continue;
            };
            if let Some(before) = columns.places[number] {
                let (known, first, name) = (NAMES[number], excerpt(&header[before]), excerpt(name));
                return Err(format!(
                    "the header has `{known}` twice, as {first:?} and as {name:?}, allowed: once; delete or rename the other column"
                ));
            }
            columns.places[number] = Some(place);
            columns.set_unit(number, &column, name)?;
        }
        columns.check()?;
        if columns.places[QW].is_none()
            && let Some(place) = columns.places[Z].take()
        {
            columns.skipped.push(header[place].clone());
        }
        columns.skipped.retain(|name| !name.is_empty());
        Ok(columns)
    }

    fn set_unit(&mut self, number: usize, column: &Column, name: &str) -> Result<(), String> {
        let Some(unit) = column.unit.as_deref() else {
            return Ok(());
        };
        let name = excerpt(name);
        let unknown =
            |allowed: &str| format!("the unit of {name:?} is not known, allowed: {allowed}");
        let known = |units: &[(&str, f64)]| {
            units
                .iter()
                .find(|(known, _)| *known == unit)
                .map(|(_, per)| *per)
        };
        match number {
            T => {
                let per = known(&UNITS_OF_TIME).ok_or_else(|| unknown("s, ms, us, ns"))?;
                self.per_unit[number] = Some(per);
            }
            X..=Z => {
                let per = known(&UNITS_OF_LENGTH).ok_or_else(|| unknown("m, cm, mm"))?;
                self.per_unit[number] = Some(per);
            }
            PHI => {
                let found = UNITS_OF_ANGLE.iter().find(|(known, _)| *known == unit);
                let (_, angle) = found.ok_or_else(|| unknown("rad, deg"))?;
                self.angle = Some(*angle);
            }
            _ => {}
        }
        Ok(())
    }

    /// Checks that the columns are those of a path.
    fn check(&self) -> Result<(), String> {
        let has = |number: usize| self.places[number].is_some();
        let has_quaternion = (QX..=QW).any(has);
        if has(PHI) && has_quaternion {
            let problem = "the header has both `phi` and a quaternion, allowed: one of the two";
            return Err(problem.to_owned());
        }
        let needed = if has_quaternion {
            &SPATIAL[..]
        } else {
            &PLANAR[..]
        };
        let missing: Vec<&str> = (needed.iter())
            .filter(|&&number| !has(number))
            .map(|&number| NAMES[number])
            .collect();
        if missing.is_empty() {
            return Ok(());
        }
        let [planar, spatial] = [&PLANAR[..], &SPATIAL[..]].map(|numbers| {
            let names: Vec<&str> = numbers.iter().map(|&number| NAMES[number]).collect();
            names.join(",")
        });
        let is_number = |name: &String| name.parse::<f64>().is_ok();
        let others = self.skipped.iter().filter(|name| !name.is_empty());
        let others: Vec<&str> = others.map(String::as_str).collect();
        let problem = match (0..NAMES.len()).any(has) {
            true if others.is_empty() => format!("the header has no `{}`", missing.join("`, `")),
            true => format!(
                "the header has no `{}`; not known: {}",
                missing.join("`, `"),
                excerpt(&others.join(", "))
            ),
            false if self.names.iter().all(is_number) => {
                "the header is not known: the line has numbers, not names, and a header is to be before it".to_owned()
            }
            false => "the header is not known; lines before it, or without names, are to be deleted or begin with #".to_owned(),
        };
        Err(format!(
            "{problem}, allowed: {planar}[,held] or {spatial}[,held], in any order, and other columns, which are skipped"
        ))
    }

    /// Whether a record has six degrees of freedom.
    pub(super) const fn is_spatial(&self) -> bool {
        self.places[QW].is_some()
    }

    /// Whether the header states the unit of a number.
    pub(super) const fn states_unit(&self, number: usize) -> bool {
        self.per_unit[number].is_some()
    }

    /// The text of a number in a row that is as long as the header; `None` if there is no such column.
    pub(super) fn field<'a>(&self, number: usize, fields: &[&'a str]) -> Option<&'a str> {
        fields.get(self.places[number]?).copied()
    }

    /// A value of a column in seconds or metres.
    pub(super) fn in_si(&self, number: usize, value: f64) -> f64 {
        // A division is rounded once; a factor of 1e-9 would be rounded, too.
        self.per_unit[number].map_or(value, |per| value / per)
    }
}

/// The name of a column, taken apart.
struct Column {
    /// Its words, in lower case: `p_RS_R_x [m]` has p, rs, r, x.
    words: Vec<String>,
    unit: Option<String>,
}

impl Column {
    fn of(name: &str) -> Self {
        let lower = name.to_lowercase();
        let (name, unit) = match lower.split_once(['[', '(']) {
            Some((name, rest)) => (name, Some(rest.trim_end_matches([']', ')', ' ']).trim())),
            None => (lower.as_str(), None),
        };
        let words = name.split(|c: char| !c.is_alphanumeric());
        let mut words: Vec<String> = words
            .filter(|word| !word.is_empty())
            .map(str::to_owned)
            .collect();
        let mut unit = unit.filter(|unit| !unit.is_empty()).map(str::to_owned);
        if unit.is_none() && words.len() > 1 && words.last().is_some_and(|word| is_unit(word)) {
            unit = words.pop();
        }
        Self { words, unit }
    }

    /// The number that a column of this name has, as an index into [`NAMES`].
    fn number(&self) -> Option<usize> {
        let (last, before) = self.words.split_last()?;
        let known = |name: &str| NAMES.iter().position(|known| *known == name);
        let has = |names: &[&str]| before.iter().any(|word| names.contains(&word.as_str()));
        if before.is_empty() {
            return match last.as_str() {
                time if TIME.contains(&time) => Some(T),
                // tx, px, posx.
                "tx" | "px" | "posx" => known("x"),
                "ty" | "py" | "posy" => known("y"),
                "tz" | "pz" | "posz" => known("z"),
                name => known(name),
            };
        }
        match last.as_str() {
            "x" | "y" | "z" | "w" if has(&QUATERNION) => known(&format!("q{last}")),
            "x" | "y" | "z" if has(&POSITION) => known(last),
            _ => None,
        }
    }
}

fn is_unit(word: &str) -> bool {
    let is_in = |units: &[(&str, f64)]| units.iter().any(|(known, _)| *known == word);
    is_in(&UNITS_OF_TIME)
        || is_in(&UNITS_OF_LENGTH)
        || UNITS_OF_ANGLE.iter().any(|(known, _)| *known == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The column of each number of [`NAMES`].
    fn places(header: &str) -> Result<Vec<Option<usize>>, String> {
        let names: Vec<String> = header.split(',').map(str::to_owned).collect();
        Columns::of(&names).map(|columns| columns.places.to_vec())
    }

    #[test]
    fn columns_have_the_names_of_other_programs() {
        let spatial = |quaternion: [usize; 4]| {
            let [x, y, z, w] = quaternion.map(Some);
            vec![Some(0), Some(1), Some(2), Some(3), None, x, y, z, w, None]
        };
        for (header, quaternion) in [
            ("timestamp,tx,ty,tz,qx,qy,qz,qw", [4, 5, 6, 7]),
            (
                "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []",
                [5, 6, 7, 4],
            ),
            (
                "Time (Seconds),Position X,Position Y,Position Z,Rotation X,Rotation Y,Rotation Z,Rotation W",
                [4, 5, 6, 7],
            ),
            (
                "%time,field.pose.position.x,field.pose.position.y,field.pose.position.z,field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w",
                [4, 5, 6, 7],
            ),
            (
                "__time,/hand/pose/position/x,/hand/pose/position/y,/hand/pose/position/z,/hand/pose/orientation/w,/hand/pose/orientation/x,/hand/pose/orientation/y,/hand/pose/orientation/z",
                [5, 6, 7, 4],
            ),
        ] {
            assert_eq!(places(header), Ok(spatial(quaternion)), "{header}");
        }
    }

    #[test]
    fn velocities_and_covariances_are_no_positions() {
        let header = [
            "t",
            "phi",
            "y",
            "x",
            "v_x",
            "twist.linear.x",
            "b_w_RS_S_x",
            "frame",
        ]
        .map(str::to_owned);
        let columns = Columns::of(&header).expect("a path");
        assert_eq!(
            columns.skipped,
            ["v_x", "twist.linear.x", "b_w_RS_S_x", "frame"]
        );
        assert_eq!(
            columns.field(X, &["0", "1", "2", "3", "4", "5", "6", "7"]),
            Some("3")
        );
    }

    #[test]
    fn a_message_about_a_long_name_fits_on_a_screen() {
        let long = "\u{f}".repeat(2000);
        for header in [format!("t,x,y,{long} x,phi"), format!("t [{long}],x,y,phi")] {
            let problem = places(&header).expect_err("a message");
            assert!(problem.chars().count() < 2000, "{problem}");
        }
    }

    #[test]
    fn headers_that_are_no_path_say_what_is_missing() {
        for (header, expected) in [
            ("t,x,y", "no `phi`"),
            ("t,x,y,z,qx,qy,qz", "no `qw`"),
            ("a,b,c", "not known"),
            ("t,x,y,phi,qw", "both `phi` and a quaternion"),
            ("t,left_pos_x,right_pos_x,y,phi", "`x` twice"),
            ("t,x [inch],y,phi", "allowed: m, cm, mm"),
        ] {
            let problem = places(header).expect_err(header);
            assert!(problem.contains(expected), "{header}: {problem}");
        }
    }
}
