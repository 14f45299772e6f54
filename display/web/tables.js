// Makes tables of plain values. The first cell of a row names it. Texts are set as texts, never as markup.

// Changes only cells that differ, so that a selection or a scroll position survives.
export function fill_rows(body, rows) {
    while (body.rows.length > rows.length) body.deleteRow(-1);
    rows.forEach((cells, place) => {
        const row = body.rows[place] ?? body.insertRow();
        while (row.cells.length > cells.length) row.deleteCell(-1);
        cells.forEach((cell, column) => {
            let element = row.cells[column];
            if (!element) {
                element = document.createElement(column === 0 ? 'th' : 'td');
                if (column === 0) element.scope = 'row';
                row.append(element);
            }
            const text = String(cell);
            if (element.textContent !== text) element.textContent = text;
        });
    });
}

export function fill_table(table, heads, rows) {
    const head = table.tHead ?? table.createTHead();
    const row = head.rows[0] ?? head.insertRow();
    while (row.cells.length > heads.length) row.deleteCell(-1);
    heads.forEach((text, column) => {
        let cell = row.cells[column];
        if (!cell) {
            cell = document.createElement('th');
            cell.scope = 'col';
            row.append(cell);
        }
        if (cell.textContent !== text) cell.textContent = text;
    });
    fill_rows(table.tBodies[0] ?? table.createTBody(), rows);
}
