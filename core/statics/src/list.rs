//! Bounded lists that never panic: items that do not fit are left out.

use heapless::Vec;

/// The first N items.
pub(crate) fn gather<T, const N: usize>(items: impl IntoIterator<Item = T>) -> Vec<T, N> {
    let mut list = Vec::new();
    for item in items.into_iter().take(N) {
        // There is room for it.
        let _ = list.push(item);
    }
    list
}
