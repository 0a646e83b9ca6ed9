//! Thinning: from the samples of a run to the few that a picture can show, which include every spike.

/// A sample: t and a value.
type Sample = (f64, f64);

/// The samples as unbroken lines, cut where values are not finite. More samples than `columns` can show are thinned to the
/// first, lowest, highest and last of each column, and gaps within a column are closed. Times must not decrease.
pub(super) fn envelope(times: &[f64], values: &[f64], columns: usize) -> Vec<Vec<Sample>> {
    thin(times, values, columns, extremes)
}

/// Like [`envelope`], with only the sample of each column that is farthest from 0.
pub(super) fn outline(times: &[f64], values: &[f64], columns: usize) -> Vec<Vec<Sample>> {
    thin(times, values, columns, |samples| {
        let farthest = samples
            .iter()
            .copied()
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        farthest.into_iter().collect()
    })
}

/// Unbroken lines, of which `pick` keeps some samples per column.
fn thin(
    times: &[f64],
    values: &[f64],
    columns: usize,
    pick: impl Fn(&[Sample]) -> Vec<Sample>,
) -> Vec<Vec<Sample>> {
    let (Some(&begin), Some(&end)) = (times.first(), times.last()) else {
        return Vec::new();
    };
    let samples: Vec<Sample> = times.iter().copied().zip(values.iter().copied()).collect();
    let finite = |sample: &Sample| sample.1.is_finite();
    if times.len() <= 4 * columns || end <= begin {
        let lines = samples.split(|sample| !finite(sample));
        return lines
            .filter(|line| !line.is_empty())
            .map(<[_]>::to_vec)
            .collect();
    }
    let column = |sample: &Sample| ((sample.0 - begin) / (end - begin) * columns as f64) as usize;
    let samples: Vec<Sample> = samples.into_iter().filter(finite).collect();
    samples
        .chunk_by(|a, b| column(b) <= column(a) + 1)
        .map(|line| {
            line.chunk_by(|a, b| column(a) == column(b))
                .flat_map(&pick)
                .collect()
        })
        .collect()
}

/// The first, lowest, highest and last of some samples, in order of time, each once.
fn extremes(samples: &[Sample]) -> Vec<Sample> {
    let by_value = |&a: &usize, &b: &usize| samples[a].1.total_cmp(&samples[b].1);
    let indices = 0..samples.len();
    let lowest = indices.clone().min_by(by_value).unwrap_or(0);
    let highest = indices.max_by(by_value).unwrap_or(0);
    let mut chosen = vec![0, lowest, highest, samples.len() - 1];
    chosen.sort_unstable();
    chosen.dedup();
    chosen.into_iter().map(|i| samples[i]).collect()
}

/// A path in the plane without the points closer than `step` to the last one chosen; the step doubles until at most `most` points
/// are left. The ends remain.
pub(super) fn sparse(path: &[(f64, f64)], step: f64, most: usize) -> Vec<(f64, f64)> {
    let mut chosen = Vec::new();
    for &point in path {
        let near = |&(x, y): &(f64, f64)| (point.0 - x).hypot(point.1 - y) < step;
        if !chosen.last().is_some_and(near) {
            chosen.push(point);
        }
    }
    if chosen.len() > most && step > 0.0 {
        return sparse(path, 2.0 * step, most);
    }
    if let Some(&end) = path.last()
        && chosen.last() != Some(&end)
    {
        chosen.push(end);
    }
    chosen
}
