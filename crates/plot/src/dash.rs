//! Cuts polylines into dashes, equally for every backend.

use crate::theme::Dash;
use crate::thin::Point;

/// Returns the alternating lengths of dashes and gaps, px for a line 1 px wide with round ends.
fn pattern(dash: Dash) -> &'static [f64] {
    match dash {
        Dash::Solid => &[],
        Dash::Dashed => &[4.5, 3.0],
        Dash::DashDot => &[5.5, 2.7, 0.2, 2.7],
        Dash::Dotted => &[0.2, 2.3],
        Dash::LongDash => &[9.0, 3.2],
    }
}

/// Returns the dashes of a polyline for a line `width` px wide.
pub(crate) fn dashed(line: &[Point], dash: Dash, width: f64) -> Vec<Vec<Point>> {
    let pattern = pattern(dash);
    if pattern.is_empty() || line.len() < 2 {
        return vec![line.to_vec()];
    }
    let mut pieces = Vec::new();
    let mut piece = vec![line[0]];
    let (mut turn, mut left) = (0, pattern[0] * width);
    for pair in line.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let way = math::hypot(to.0 - from.0, to.1 - from.1);
        let mut gone = 0.0;
        while way - gone > left {
            gone += left;
            let at = (from.0 + (to.0 - from.0) * gone / way, from.1 + (to.1 - from.1) * gone / way);
            if turn % 2 == 0 {
                piece.push(at);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![at];
            }
            turn = (turn + 1) % pattern.len();
            left = pattern[turn] * width;
        }
        left -= way - gone;
        if turn % 2 == 0 {
            piece.push(to);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::thin::length;

    #[test]
    fn dashes_go_round_corners_and_add_up() {
        // 75 px in two legs are ten periods of 7.5 px: 45 px drawn, 30 px left out.
        let line = [(0.0, 0.0), (40.0, 0.0), (40.0, 35.0)];
        let pieces = dashed(&line, Dash::Dashed, 1.0);
        assert_eq!(pieces.len(), 10);
        assert!((length(&pieces) - 45.0).abs() < 1e-9);
        assert!(pieces.iter().any(|p| p.len() == 3 && p[1] == (40.0, 0.0)), "{pieces:?}");
        assert_eq!(dashed(&line, Dash::Solid, 1.0), [line.to_vec()]);
    }
}
