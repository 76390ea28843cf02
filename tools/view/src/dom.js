// Elements of the page, in a line each.

export function element(tag, properties = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties))
        if (name === "data") Object.assign(made.dataset, value);
        else if (name.startsWith("aria")) made.setAttribute(`aria-${name.slice(4).toLowerCase()}`, value);
        else made[name] = value;
    made.append(...children.filter((child) => child !== null && child !== undefined));
    return made;
}

export const byId = (id) => document.getElementById(id);

// A list to choose from: [value, label] each.
export function choice(id, options, value, onChange) {
    const made = element("select", { id }, ...options.map(([name, label]) => element("option", { value: name, textContent: label })));
    made.value = value;
    made.addEventListener("change", () => onChange(made.value));
    return made;
}

export function row(label, control, key) {
    return element("label", { className: "row" }, element("span", { textContent: label }), control, key ? element("kbd", { textContent: key }) : null);
}
