//! Where a line ends: eight bytes at a time, since every byte of a program passes here.

const ONES: u64 = 0x0101_0101_0101_0101;
const HIGHS: u64 = 0x8080_8080_8080_8080;

/// Index of the first LF or CR.
pub fn line_end(bytes: &[u8]) -> Option<usize> {
    let (words, rest) = bytes.as_chunks::<8>();
    for (i, word) in words.iter().enumerate() {
        let word = u64::from_le_bytes(*word);
        let hits = zeros(word ^ (ONES * b'\n' as u64)) | zeros(word ^ (ONES * b'\r' as u64));
        if hits != 0 {
            return Some(i * 8 + hits.trailing_zeros() as usize / 8);
        }
    }
    rest.iter().position(|b| matches!(b, b'\n' | b'\r')).map(|i| words.len() * 8 + i)
}

/// The high bit of the lowest byte that is zero, and perhaps of some above it.
const fn zeros(word: u64) -> u64 {
    word.wrapping_sub(ONES) & !word & HIGHS
}

#[cfg(test)]
mod tests {
    use super::line_end;

    #[test]
    fn finds_what_a_plain_search_finds() {
        let mut x = 7_u64;
        for _ in 0..20_000 {
            let bytes: Vec<u8> = (0..x % 40)
                .map(|_| {
                    x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    [b'\n', b'\r', 0, 1, 0x0B, 0x8A, b' ', b'G', 0xFF, b'1', b'2', 9][(x >> 40) as usize % 12]
                })
                .collect();
            assert_eq!(line_end(&bytes), bytes.iter().position(|b| matches!(b, b'\n' | b'\r')), "{bytes:?}");
            x = x.wrapping_add(1);
        }
    }
}
