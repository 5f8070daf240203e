// The picture, and dragging its joints.

import { h, set } from "./dom";
import { Island } from "./island";
import type { Machine } from "./machine";
import type { Picture } from "./protocol";
import { pictureStyles } from "./styles";
import { onLanguage, say, word } from "./words";

/** How near to a joint, in pixels of the screen, a pointer takes it. */
const REACH = 28;

export class PictureView {
    readonly element: HTMLElement;
    #machine: Machine;
    #island = new Island("picture", pictureStyles);
    #grip = h("div", { class: "grip", "aria-hidden": "true" });
    #banner = h("p", { class: "banner", role: "status" });
    #hint = h("p", { class: "hint" }, say((w) => w.dragHint));
    #picture: Picture | null = null;
    #dragged: string | null = null;

    constructor(machine: Machine) {
        this.#machine = machine;
        this.element = h("div", { class: "stage" }, this.#island.element, this.#grip, this.#banner, this.#hint);
        const { element } = this.#island;
        element.addEventListener("pointerdown", (event) => this.#down(event));
        // A finger on a joint drags it; elsewhere it scrolls the page.
        const touch = (event: TouchEvent): void => {
            const finger = event.touches[0];
            if (event.touches.length === 1 && finger && this.#nearest(finger) !== null) event.preventDefault();
        };
        element.addEventListener("touchstart", touch, { passive: false });
        element.addEventListener("pointermove", (event) => this.#move(event));
        for (const end of ["pointerup", "pointercancel"]) element.addEventListener(end, () => this.#up());
        element.addEventListener("pointerleave", () => this.#hover(null));
        machine.moved.on(() => this.#show());
        onLanguage(() => this.#show());
    }

    /** The drawing as text, to copy. */
    get svg(): string | null {
        return this.#picture?.svg ?? null;
    }

    /** Draws a frame of a simulation in place of the position. */
    draw(picture: Picture): void {
        this.#picture = picture;
        this.#island.svg(picture.svg);
        this.#hover(this.#dragged);
    }

    #show(): void {
        const { last, why, note, isOld, about, text } = this.#machine;
        const isStale = isOld || why !== null;
        if (last !== null && last.picture !== this.#picture) this.draw(last.picture);
        if (last === null && (text === null || !isOld)) {
            this.#picture = null;
            this.#island.clear();
        }
        set(this.element, "data-old", isStale && this.#picture !== null);
        set(this.element, "data-stopped", note !== null && why === null);
        const words: string[] = [];
        if (isOld && last !== null) words.push(word().oldText);
        if (why !== null) words.push(why);
        else if (note !== null) words.push(note());
        this.#banner.textContent = words.join(" ");
        this.#banner.hidden = words.length === 0;
        this.#hint.hidden = this.#picture === null || words.length > 0;
        set(this.#island.element, "role", "group");
        set(this.#island.element, "aria-label", about === null ? null : word().pictureLabel(about.name));
    }

    /** The screen's pixels per pixel of the viewBox, and its corner on the screen. */
    #frame(): { scale: number; left: number; top: number } | null {
        const svg = this.#island.body.querySelector("svg");
        const matrix = svg?.getScreenCTM();
        return matrix ? { scale: matrix.a, left: matrix.e, top: matrix.f } : null;
    }

    #toPlane(event: PointerEvent): [number, number] | null {
        const frame = this.#frame();
        const picture = this.#picture;
        if (frame === null || picture === null) return null;
        const x = (event.clientX - frame.left) / frame.scale;
        const y = (event.clientY - frame.top) / frame.scale;
        return [(x - picture.origin[0]) / picture.scale, (picture.origin[1] - y) / picture.scale];
    }

    #onScreen(joint: { x: number; y: number }): { x: number; y: number } | null {
        const frame = this.#frame();
        const picture = this.#picture;
        if (frame === null || picture === null) return null;
        return {
            x: frame.left + frame.scale * (picture.origin[0] + picture.scale * joint.x),
            y: frame.top + frame.scale * (picture.origin[1] - picture.scale * joint.y),
        };
    }

    #nearest(event: { clientX: number; clientY: number }): string | null {
        let best: { name: string; distance: number } | null = null;
        for (const joint of this.#picture?.joints ?? []) {
            const at = this.#onScreen(joint);
            if (at === null) continue;
            const distance = Math.hypot(at.x - event.clientX, at.y - event.clientY);
            if (distance < (best?.distance ?? REACH)) best = { name: joint.name, distance };
        }
        return best?.name ?? null;
    }

    #down(event: PointerEvent): void {
        if (!event.isPrimary || event.button !== 0 || this.#machine.at === null) return;
        const joint = this.#nearest(event);
        if (joint === null) return;
        event.preventDefault();
        this.#dragged = joint;
        this.#island.element.setPointerCapture(event.pointerId);
        set(this.element, "data-dragging", true);
        this.#hover(joint);
    }

    #move(event: PointerEvent): void {
        if (this.#dragged === null) {
            if (event.pointerType !== "touch") this.#hover(this.#nearest(event));
            return;
        }
        const to = this.#toPlane(event);
        if (to !== null) void this.#machine.drag(this.#dragged, to);
    }

    #up(): void {
        this.#dragged = null;
        set(this.element, "data-dragging", false);
        this.#hover(null);
    }

    /** A ring about the joint that the pointer would take. */
    #hover(name: string | null): void {
        const joint = this.#picture?.joints.find((candidate) => candidate.name === name);
        const at = joint && this.#onScreen(joint);
        this.#grip.hidden = !at;
        if (!at) return;
        const box = this.element.getBoundingClientRect();
        this.#grip.style.translate = `${at.x - box.left}px ${at.y - box.top}px`;
    }
}
