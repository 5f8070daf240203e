//! The name that was meant.

/// The candidate with the smallest edit distance to `name`, up to half of its letters and 3.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (name.chars().count() / 2).clamp(1, 3);
    let distance = |candidate: &str| match name.eq_ignore_ascii_case(candidate) {
        true => 0,
        false => strsim::osa_distance(name, candidate),
    };
    let distances = candidates.into_iter().map(|candidate| (distance(candidate), candidate));
    let near = distances.filter(|(distance, _)| *distance <= limit);
    near.min_by_key(|(distance, _)| *distance).map(|(_, candidate)| candidate)
}
