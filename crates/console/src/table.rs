//! Tables on a terminal: heads, a line, rows.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};

/// A line under the heads, nothing else.
const STYLE: TableStyle = TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// A table with these heads, as wide as it becomes.
pub fn plain<'a>(heads: impl IntoIterator<Item = &'a str>) -> Table {
    let mut table = Table::new();
    table.load_style(STYLE).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(heads);
    table
}

/// Puts the cells of columns to the right, as numbers stand.
pub fn to_the_right(table: &mut Table, columns: std::ops::RangeInclusive<usize>) {
    let count = columns.end() + 1 - columns.start();
    let cells = table.column_iter_mut().skip(*columns.start()).take(count);
    cells.for_each(|column| column.set_cell_alignment(CellAlignment::Right));
}
