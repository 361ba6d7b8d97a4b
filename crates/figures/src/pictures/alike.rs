//! Curves that coincide in a plot: drawn once, with all their names.

/// Maximum difference of equal curves relative to their range, a third of a pixel.
const ALIKE: f64 = 2e-4;
/// Maximum number of names in a legend entry.
const MOST_NAMED: usize = 3;

/// Groups the indices of equal curves. A curve consists of one or more columns.
pub(crate) fn groups(curves: &[Vec<&[f64]>]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (place, curve) in curves.iter().enumerate() {
        match groups.iter_mut().find(|group| are_alike(&curves[group[0]], curve)) {
            Some(group) => group.push(place),
            None => groups.push(vec![place]),
        }
    }
    groups
}

fn are_alike(a: &[&[f64]], b: &[&[f64]]) -> bool {
    let near = |(a, b): (&&[f64], &&[f64])| {
        let (low, high) = a.iter().fold((f64::MAX, f64::MIN), |(low, high), &v| (low.min(v), high.max(v)));
        a.len() == b.len() && a.iter().zip(*b).all(|(a, b)| (a - b).abs() <= ALIKE * (high - low))
    };
    a.len() == b.len() && a.iter().zip(b).all(near)
}

/// Returns the legend entry of a group.
pub(crate) fn name(names: &[&str]) -> String {
    match names {
        [only] => (*only).to_owned(),
        _ if names.len() <= MOST_NAMED => format!("{} (alike)", names.join(", ")),
        _ => format!(
            "{} and {} more (alike)",
            names[..MOST_NAMED - 1].join(", "),
            names.len() + 1 - MOST_NAMED
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_by_less_than_a_pixel_is_one() {
        let near: Vec<f64> = (0..100).map(|i| f64::from(i) + 0.01 * f64::from(i % 2)).collect();
        let far: Vec<f64> = (0..100).map(|i| f64::from(i) + 0.05 * f64::from(i % 2)).collect();
        let line: Vec<f64> = (0..100).map(f64::from).collect();
        let curves = [vec![&line[..]], vec![&far], vec![&near], vec![&line[..99]], vec![&line[..], &far]];
        assert_eq!(groups(&curves), [vec![0, 2], vec![1], vec![3], vec![4]]);
        // Constant curves are equal only if their values are.
        assert_eq!(groups(&[vec![&[1.0; 3][..]], vec![&[1.0; 3]], vec![&[2.0; 3]]]), [vec![0, 1], vec![2]]);
    }

    #[test]
    fn many_names_are_counted() {
        assert_eq!([name(&["a"]), name(&["a", "b"])], ["a", "a, b (alike)"]);
        assert_eq!(name(&["a", "b", "c", "d", "e"]), "a, b and 3 more (alike)");
    }
}
