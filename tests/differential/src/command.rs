//! The program, for a list of solvers.

use crate::compare::compare;
use crate::differences::show;
use crate::families::{FAMILIES, Family};
use crate::measures::MEASURES;
use crate::subject::Solver;
use std::ops::Range;
use std::process::ExitCode;

/// Runs the program with its arguments:
///
/// ```text
/// compare FAMILY[,FAMILY..] A B [FIRST..END]   which frames of A and B are equal; for each run that differs a line on its first such frame
/// MEASURE FAMILY[,FAMILY..] A[,B..] [FIRST..END]   laws, tops, mirror, rates, cut: how a solver fares; lines on the seeds to blame
/// show FAMILY:SEED A[,B..] [FIRST..END]        one run in words, these frames of it
/// ```
///
/// Without arguments it lists families, measures and solvers. Figures go to standard output, lines on single seeds to standard error.
pub fn run(arguments: &[String], solvers: &[Solver]) -> ExitCode {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match answered(&words, solvers) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            list(solvers);
            ExitCode::from(2)
        }
    }
}

fn answered(words: &[&str], solvers: &[Solver]) -> Result<(), String> {
    match *words {
        ["compare", families, a, b, ref rest @ ..] => {
            let pair = [solver(solvers, a)?, solver(solvers, b)?];
            for family in all(families)? {
                let found = compare(family, pair, seeds(rest, family.count)?);
                println!("{} {a} {b}\n{found}", family.name);
                found.missing.iter().for_each(|line| eprintln!("{line}"));
                found.differences.iter().for_each(|line| eprintln!("{line}"));
            }
            Ok(())
        }
        ["show", run, names, ref rest @ ..] => {
            let (family, seed) = run.split_once(':').ok_or("show FAMILY:SEED")?;
            let seed: u64 = seed.parse().map_err(|_| "a seed is a number")?;
            let case = (known(family)?.case)(seed).ok_or("no such seed")?;
            let frames = seeds(rest, case.hands.len() as u64)?;
            let chosen: Result<Vec<_>, _> = names.split(',').map(|name| solver(solvers, name)).collect();
            show(&case, &chosen?, frames.start as usize..frames.end as usize);
            Ok(())
        }
        [name, families, names, ref rest @ ..] => {
            let measure = MEASURES.iter().find(|measure| measure.0 == name);
            let measure = measure.ok_or_else(|| format!("no measure {name}"))?.1;
            for family in all(families)? {
                for name in names.split(',') {
                    let solver = solver(solvers, name)?;
                    let found = measure(family, solver, seeds(rest, family.count)?);
                    println!("{} {name}: {}", family.name, found.line);
                    found.seeds.iter().for_each(|line| eprintln!("{} {name} {line}", family.name));
                }
            }
            Ok(())
        }
        _ => Err("compare FAMILY A B [FIRST..END] | MEASURE FAMILY A [FIRST..END] | show FAMILY:SEED A,B [FIRST..END]".to_owned()),
    }
}

fn list(solvers: &[Solver]) {
    for Family {
        name, count, about, ..
    } in &FAMILIES
    {
        eprintln!("family {name} 0..{count}: {about}");
    }
    for (name, _, about) in &MEASURES {
        eprintln!("measure {name}: {about}");
    }
    let names: Vec<_> = solvers.iter().map(|solver| solver.name).collect();
    eprintln!("solvers {}", names.join(", "));
}

fn all(names: &str) -> Result<Vec<&'static Family>, String> {
    names.split(',').map(known).collect()
}

fn known(name: &str) -> Result<&'static Family, String> {
    let family = FAMILIES.iter().find(|family| family.name == name);
    family.ok_or_else(|| format!("no family {name}"))
}

fn solver(solvers: &[Solver], name: &str) -> Result<Solver, String> {
    let solver = solvers.iter().find(|solver| solver.name == name);
    solver.copied().ok_or_else(|| format!("no solver {name}"))
}

/// `3..7`, or everything.
fn seeds(words: &[&str], count: u64) -> Result<Range<u64>, String> {
    let Some(word) = words.first() else {
        return Ok(0..count);
    };
    let ends = word
        .split_once("..")
        .and_then(|(first, end)| Some(first.parse().ok()?..end.parse().ok()?));
    ends.ok_or_else(|| format!("{word}: not FIRST..END"))
}
