// Tabs beside the chart, each a question of a designer with its tasks.

import { node } from "./dom.js";
import { Task } from "./task.js";

// Tabs with the part of the saw that decides their question and the names of their tasks.
const TABS = [
  { name: "chart", title: "Chart", tasks: [] },
  { name: "cut", title: "Cut", part: "cut", tasks: ["cut", "washboard"] },
  { name: "motion", title: "Run-up and response", part: "runup", tasks: ["runup", "response"] },
  { name: "guides", title: "Guides", part: "guides", tasks: ["gap", "fit", "place"] },
  { name: "spread", title: "Size, tolerances, map", part: "blade", tasks: ["size", "study", "map"] },
];

export class Tabs {
  #all = [];

  // Of the `listeners`, `onTab(part)` is called with the part that decides the question of a tab; the others are for tasks.
  constructor(place, panels, state, begun, answers, listeners) {
    this.place = place;
    for (const { name, title, part, tasks } of TABS) {
      const open = () => {
        this.#show(name);
        if (part) listeners.onTab(part);
      };
      const tab = node("button", { type: "button", role: "tab", id: `tab-${name}`, textContent: title, "aria-controls": `group-${name}`, onclick: open });
      place.append(tab);
      const group = panels.querySelector(`#group-${name}`) ?? node("div", { id: `group-${name}`, role: "tabpanel", "aria-labelledby": tab.id });
      panels.append(group);
      this.#all.push({ name, tab, group, tasks: tasks.map((task) => new Task(group, task, state, begun, answers, listeners)) });
    }
    place.addEventListener("keydown", (event) => this.#walk(event));
    this.#show("chart");
  }

  #show(name) {
    for (const { name: own, tab, group } of this.#all) {
      const chosen = own === name;
      group.hidden = !chosen;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      // On a narrow screen, the tabs are one row that is scrolled to the chosen tab.
      if (chosen) this.place.scrollLeft = tab.offsetLeft - 0.5 * (this.place.clientWidth - tab.clientWidth);
    }
    this.refresh();
  }

  refresh() {
    for (const { tasks } of this.#all.filter(({ group }) => !group.hidden)) for (const task of tasks) task.refresh();
  }

  // The left and right arrow keys change the tab, as is usual for lists of tabs.
  #walk(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const { tab } = this.#all.at((this.#all.findIndex((one) => one.tab === document.activeElement) + step) % this.#all.length);
    tab.focus();
    tab.click();
    event.preventDefault();
  }
}
