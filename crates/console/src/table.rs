//! Tables for the terminal: column headings, a separator line and rows.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};

/// Table style with a separator line below the headings and no other lines.
const STYLE: TableStyle = TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// Returns an empty table with these column headings and unlimited width.
pub fn plain<'a>(heads: impl IntoIterator<Item = &'a str>) -> Table {
    let mut table = Table::new();
    table.load_style(STYLE).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(heads);
    table
}

/// Right-aligns the cells of a range of columns.
pub fn to_the_right(table: &mut Table, columns: std::ops::RangeInclusive<usize>) {
    let count = columns.end() + 1 - columns.start();
    let cells = table.column_iter_mut().skip(*columns.start()).take(count);
    cells.for_each(|column| column.set_cell_alignment(CellAlignment::Right));
}
