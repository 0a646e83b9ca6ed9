//! Size and centroid of a body, from its vertices (m, body frame).

use crate::vector::{add, cross, distance, scaled, sub};

/// L (m) of a body: the largest distance between two vertices; 1 for a point.
pub fn size(vertices: &[[f64; 2]]) -> f64 {
    let pairs = (vertices.iter()).flat_map(|&a| vertices.iter().map(move |&b| distance(a, b)));
    let largest = pairs.fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

/// The centroid of a body (m), body frame: of the polygon's area; of a point or a rod, the mean of the vertices.
pub fn centroid(vertices: &[[f64; 2]]) -> [f64; 2] {
    let first = vertices.first().copied().unwrap_or_default();
    let (mut twice_area, mut sum) = (0.0, [0.0; 2]);
    for pair in vertices.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|vertex| sub(vertex, first));
        let twice = cross(a, b);
        twice_area += twice;
        sum = add(sum, scaled(add(a, b), twice));
    }
    if vertices.len() < 3 || twice_area == 0.0 {
        let all = vertices
            .iter()
            .fold([0.0; 2], |all, &vertex| add(all, vertex));
        return scaled(all, 1.0 / vertices.len().max(1) as f64);
    }
    add(first, scaled(sum, 1.0 / (3.0 * twice_area)))
}

#[cfg(test)]
mod tests {
    use super::centroid;

    #[test]
    fn centroid_of_an_area_and_of_a_rod() {
        let [x, y] = centroid(&[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]]);
        assert!((x - 1.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
        assert_eq!(centroid(&[[0.0, 0.0], [2.0, 4.0]]), [1.0, 2.0]);
    }
}
