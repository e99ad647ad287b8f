// Keeps a figure at the window of time that all have in common: each curve shows as many points as
// can be seen, the smallest and the largest number of every stretch among them, and y axes follow
// what is shown. A figure that is not on the screen waits until it is.
//
// Runs for each figure when the page is ready, and whenever the window changes.
//
// common: the window. own: the figure's range of time. root: its plots. rows: of each y axis
// { y, follows, curves }, of each curve { full: all its points, columns: one over time or two of a
// path, shown: what is drawn, line: its renderer }.

const POINTS = 3000;
const ROOM = 0.06;

// Index of the first time that is not below t.
function from(time, t) {
  let low = 0, high = time.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle] < t) low = middle + 1; else high = middle;
  }
  return low;
}

// Points of a path that are equally far from each other along it: stretches stay round.
function even(first, last, [x, y], kept) {
  const span = (column) => {
    let low = Infinity, high = -Infinity;
    for (let i = first; i < last; i++) {
      if (column[i] < low) low = column[i];
      if (column[i] > high) high = column[i];
    }
    return high > low ? high - low : 1;
  };
  const width = span(x), height = span(y);
  const step = (i) => Math.hypot((x[i] - x[i - 1]) / width, (y[i] - y[i - 1]) / height) || 0;
  let whole = 0, gone = 0, next = 0;
  for (let i = first + 1; i < last; i++) whole += step(i);
  for (let i = first + 1; i < last; i++) {
    gone += step(i);
    if (gone >= next) { kept.add(i); next = gone + 2 * whole / POINTS; }
  }
}

// Indices of [first, last) that keep the extremes and the gaps of all columns.
function thinned(first, last, columns) {
  const count = last - first;
  if (count <= POINTS) return Uint32Array.from({ length: count }, (_, i) => first + i);
  const width = Math.ceil(count * 3 * columns.length / POINTS);
  const kept = new Set([first, last - 1]);
  if (columns.length > 1) even(first, last, columns, kept);
  for (const column of columns) {
    for (let start = first; start < last; start += width) {
      const end = Math.min(start + width, last);
      let low = -1, high = -1, gap = -1;
      for (let i = start; i < end; i++) {
        const y = column[i];
        if (y !== y) { if (gap < 0) gap = i; continue; }
        if (low < 0 || y < column[low]) low = i;
        if (high < 0 || y > column[high]) high = i;
      }
      for (const i of [low, high, gap]) if (i >= 0) kept.add(i);
    }
  }
  return Uint32Array.from(kept).sort();
}

// Show what a curve has in the window; its extremes there.
function show(curve) {
  const time = curve.full.data.time;
  const columns = curve.columns.map((name) => curve.full.data[name]);
  // one point beyond each end, so that the line goes on to the edge
  const first = Math.max(from(time, common.start) - 1, 0);
  const last = Math.min(from(time, common.end) + 1, time.length);
  const at = thinned(first, last, columns);
  const of = (column) => Float64Array.from(at, (i) => column[i]);
  const y = of(columns[columns.length - 1]);
  curve.shown.data = { x: of(columns.length > 1 ? columns[0] : time), y };
  let low = Infinity, high = -Infinity;
  for (const value of y) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

function refresh() {
  root.stale = false;
  own.setv({ start: common.start, end: common.end });
  const whole = common.start <= common.reset_start && common.end >= common.reset_end;
  for (const row of rows) {
    let low = Infinity, high = -Infinity;
    for (const curve of row.curves) {
      const [least, most] = show(curve);
      if (!curve.line.visible) continue;
      low = Math.min(low, least);
      high = Math.max(high, most);
    }
    if (!row.follows) continue;
    if (whole) {
      row.y.setv({ start: row.y.reset_start, end: row.y.reset_end });
    } else if (low <= high) {
      const room = ROOM * (high - low) || 0.05 * Math.abs(high) || 1;
      row.y.setv({ start: low - room, end: high + room });
    }
  }
}

function watch() {
  const place = document.querySelector(`[data-root-id="${root.id}"]`).parentElement;
  new IntersectionObserver((entries) => {
    root.seen = entries[entries.length - 1].isIntersecting;
    if (root.seen && root.stale) refresh();
  }, { rootMargin: "25%" }).observe(place);
  addEventListener("beforeprint", refresh);
}

// start and end change one after the other: once a frame is enough
if (!root.stale) requestAnimationFrame(() => { if (root.seen && root.stale) refresh(); });
root.stale = true;
if (root.seen === undefined) {
  root.seen = false;
  watch();
}
