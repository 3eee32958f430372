// Style and script of the index page.
#pragma once

namespace retarget::batch {

inline constexpr const char* kIndexStyle = R"(
h2 { margin: 28px 0 6px; }
.scroll { overflow-x: auto; margin: 10px 0; }
td, th { padding: 3px 8px; border-bottom: 1px solid var(--rule); vertical-align: middle; }
th { text-align: left; vertical-align: bottom; position: sticky; top: 0; background: var(--paper); }
th button { border: 0; padding: 0; text-align: left; background: none; cursor: pointer; }
th[aria-sort=ascending] button::after { content: " \25B2"; }
th[aria-sort=descending] button::after { content: " \25BC"; }
td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td.bad { color: var(--bad); }
td.met { color: var(--good); }
/* Of the picture the lower half, which is the result. */
td img { display: block; width: 72px; height: 90px; object-fit: cover; object-position: 50% 100%; }
.plots { display: flex; flex-wrap: wrap; gap: 14px; margin: 10px 0; }
.plots figure { min-width: 282px; border: 1px solid var(--rule); border-radius: 6px; padding: 6px 8px; }
.key { display: flex; flex-wrap: wrap; gap: 4px 16px; color: var(--muted); }
.key i { display: inline-block; width: 18px; border-top: 3px solid; vertical-align: middle; margin-right: 5px; }
)";

// Sorts by the column whose head is clicked; hides what meets every requirement.
inline constexpr const char* kIndexScript = R"(<script>
const body = document.querySelector('#pairs tbody');
const heads = [...document.querySelectorAll('#pairs th')];
const key = (row, c) => {
  const cell = row.cells[c];
  const text = cell.dataset.v ?? cell.textContent;
  const number = Number(text);
  return text.trim() === '' ? null : Number.isNaN(number) ? text : number;
};
heads.forEach((head, c) => head.querySelector('button')?.addEventListener('click', () => {
  const sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
  heads.forEach((h) => h.removeAttribute('aria-sort'));
  head.setAttribute('aria-sort', sign === 1 ? 'ascending' : 'descending');
  const rows = [...body.rows].map((row) => [key(row, c), row]);
  rows.sort(([a], [b]) => {
    if (a === null || b === null) return (a === null) - (b === null);
    if (typeof a === 'number' && typeof b === 'number') return sign * (a - b);
    return sign * String(a).localeCompare(String(b), 'en', { numeric: true });
  });
  body.append(...rows.map(([, row]) => row));
}));
document.querySelector('#missed').addEventListener('change', (event) => {
  for (const row of body.rows) row.hidden = event.target.checked && !row.classList.contains('missed');
});
</script>
)";

}  // namespace retarget::batch
