// How the speeds move with the numbers of the scene: a bar beside each field.

const named = (change, path) => (path.endsWith("_deg") || change.includes("degree") ? change.replace("1 degree", "1°") : change);
function signed(value) {
  const size = Math.abs(value) < 9.95 ? Math.abs(value).toFixed(1) : String(Math.round(Math.abs(value)));
  return size === "0.0" ? "±0" : `${value < 0 ? "−" : "+"}${size}`;
}

// The onset that is the flutter speed.
function flutterBand({ instabilities, flutter_speed_rpm }) {
  if (flutter_speed_rpm === null) return -1;
  return instabilities.findIndex(({ counted_rpm }) => counted_rpm.some(([from]) => from === flutter_speed_rpm));
}

// Path, share of the largest influence and words, of each number that moves a speed.
export function influences(entries, report) {
  const band = flutterBand(report);
  const critical = report.critical_speeds[0]?.rpm;
  const found = entries.map((entry) => {
    const percent = [entry.critical_speeds_percent[0], band < 0 ? null : entry.onsets_percent[band]];
    const speeds = [critical, report.flutter_speed_rpm];
    const rpm = percent.map((p, k) => (typeof p === "number" && speeds[k] ? (p / 100) * speeds[k] : null));
    return { path: entry.parameter, change: named(entry.change, entry.parameter), rpm };
  });
  const size = ({ rpm }) => Math.max(...rpm.map((value) => Math.abs(value ?? 0)));
  const most = Math.max(...found.map(size), Number.MIN_VALUE);
  return found.map((one) => {
    const parts = [["critical", one.rpm[0]], ["flutter", one.rpm[1]]].filter(([, value]) => value !== null);
    const words = parts.map(([name, value]) => `${name} ${signed(value)}`).join(", ");
    return { path: one.path, share: size(one) / most, words: words && `+${one.change}: ${words} rpm` };
  });
}
