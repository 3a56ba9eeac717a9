//! Parts of a set whose members are linked with one another.

/// The numbers below `count` in the parts that links connect, each ascending, by their first numbers.
pub fn connected_parts(count: usize, links: impl Iterator<Item = [usize; 2]>) -> Vec<Vec<usize>> {
    let mut first: Vec<usize> = (0..count).collect();
    for [x, y] in links {
        let [to, from] = [first[x].min(first[y]), first[x].max(first[y])];
        let moved = first.iter_mut().filter(|name| **name == from);
        moved.for_each(|name| *name = to);
    }
    let mut parts = vec![Vec::new(); count];
    for (number, name) in first.into_iter().enumerate() {
        parts[name].push(number);
    }
    parts.retain(|part| !part.is_empty());
    parts
}

#[cfg(test)]
mod tests {
    use super::connected_parts;

    #[test]
    fn chains_of_links_make_one_part() {
        let links = [[5, 3], [1, 4], [3, 1], [2, 2]];
        let parts = connected_parts(6, links.into_iter());
        assert_eq!(parts, [vec![0], vec![1, 3, 4, 5], vec![2]]);
    }
}
