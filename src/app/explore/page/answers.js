// The answers on the page: the chart with its verdict, the influences, and those of the tasks. Each belongs to a scene, and
// is marked when this is an earlier one than the present scene.

export class Answers {
  #all = new Map();

  constructor(state) {
    this.state = state;
  }

  // Records that a place shows an answer from now on; `isOf(scene)` returns whether it is that for a scene. It is marked
  // when it has been of an earlier scene for `grace_ms`, within which the next answer usually comes.
  show(place, isOf, grace_ms = 0) {
    clearTimeout(this.#all.get(place)?.timer);
    this.#all.set(place, { isOf, grace_ms, timer: 0 });
    place.classList.remove("earlier");
    this.#refresh(place);
  }

  refresh() {
    for (const place of this.#all.keys()) this.#refresh(place);
  }

  // Marks an answer of an earlier scene at once, because no other one will come.
  end(place) {
    if (this.#all.has(place)) this.#refresh(place, 0);
  }

  #refresh(place, grace_ms = this.#all.get(place).grace_ms) {
    const answer = this.#all.get(place);
    const isEarlier = !answer.isOf(this.state.scene);
    if (isEarlier && grace_ms > 0) {
      answer.timer ||= setTimeout(() => place.classList.add("earlier"), grace_ms);
      return;
    }
    clearTimeout(answer.timer);
    answer.timer = 0;
    place.classList.toggle("earlier", isEarlier);
  }
}
