//! Bounded lists that never panic: items that do not fit are left out.

use heapless::Vec;

/// The first N items.
pub(crate) fn gather<T, const N: usize>(items: impl IntoIterator<Item = T>) -> Vec<T, N> {
    let mut list = Vec::new();
    fill(&mut list, items);
    list
}

/// The first N items, in place: an empty list that is large.
pub(crate) fn fill<T, const N: usize>(list: &mut Vec<T, N>, items: impl IntoIterator<Item = T>) {
    for item in items.into_iter().take(N) {
        // There is room for it.
        let _ = list.push(item);
    }
}
