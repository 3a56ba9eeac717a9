// Measures the times from a move, or from the release of a drag, to what is painted. The browser test reads them.

export class Times {
  // In milliseconds: from each move to the painted results, and from each release to the painted chart.
  latencies = { critical: [], bands: [], draft: [], scene: [], release: [] };
  // Number of results that were shown before their chart.
  ahead = 0;
  // Accuracy and computing time of each painted chart.
  computed = [];
  // Parts of the times of drafts.
  parts = [];
  // Saw of the painted chart as text; null if the chart is a draft.
  painted = null;
  // Saw of the painted chart as text, also of a draft.
  newest = null;

  // Measures results before their chart. Moves of an earlier request for which such results were shown are not counted
  // again.
  early(request, found) {
    this.ahead += 1;
    if (!request.draft) return;
    const kind = found.bands ? "bands" : "critical";
    const counted = request.counted[kind] ?? 0;
    request.counted[kind] = request.stamps.length;
    afterPainting((now) => this.latencies[kind].push(...request.stamps.slice(counted).map((stamp) => now - stamp)));
  }

  // Measures a chart that was received and drawn at these times.
  chart(request, computing, received, drawn) {
    afterPainting((now) => {
      const kind = request.draft ? "draft" : "scene";
      if (request.draft) this.parts.push(partsOf(request, computing, received, drawn, now));
      this.latencies[kind].push(...request.stamps.map((stamp) => now - stamp));
      if (request.released !== undefined) this.latencies.release.push(now - request.released);
      this.computed.push([kind, computing]);
      this.painted = request.draft ? null : request.saw;
      this.newest = request.saw;
    });
  }
}

// Divides the time from a move to its painted chart, in milliseconds, into waiting for the chart that was being
// computed at the move, computing, sending, drawing and painting.
function partsOf({ stamps, asked, answered }, computing, received, drawn, now) {
  return {
    waiting: stamps.map((stamp) => asked - stamp), computing, sending: answered - asked - computing, drawing: drawn - received, painting: now - drawn,
  };
}

// Calls a function after the next frame is painted.
function afterPainting(then) {
  const channel = new MessageChannel();
  channel.port1.onmessage = () => then(performance.now());
  requestAnimationFrame(() => channel.port2.postMessage(null));
}
