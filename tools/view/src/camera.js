// What part of the plane a pane shows, in metres from the model's middle.

export class Camera {
    constructor() {
        this.x = this.y = 0;
        this.scale = 1; // pixels of the screen a metre
        this.width = this.height = 1;
    }

    fit([x0, y0, x1, y1], margin = 0.04) {
        this.x = 0.5 * (x0 + x1);
        this.y = 0.5 * (y0 + y1);
        const w = Math.max(x1 - x0, 1e-9), h = Math.max(y1 - y0, 1e-9);
        this.scale = Math.min(this.width / w, this.height / h) / (1 + 2 * margin);
        this.fitted = this.scale;
    }

    toWorld(px, py) {
        return [this.x + (px - 0.5 * this.width) / this.scale, this.y - (py - 0.5 * this.height) / this.scale];
    }

    toScreen(x, y) {
        return [0.5 * this.width + (x - this.x) * this.scale, 0.5 * this.height - (y - this.y) * this.scale];
    }

    // The point under the pointer stays there.
    zoom(factor, px = 0.5 * this.width, py = 0.5 * this.height) {
        const [x, y] = this.toWorld(px, py);
        const fitted = this.fitted || this.scale;
        this.scale = Math.min(Math.max(this.scale * factor, fitted / 20), fitted * 1e5);
        this.x = x - (px - 0.5 * this.width) / this.scale;
        this.y = y + (py - 0.5 * this.height) / this.scale;
    }

    pan(dx, dy) {
        this.x -= dx / this.scale;
        this.y += dy / this.scale;
    }

    // x0, y0, x1, y1
    get view() {
        const w = (0.5 * this.width) / this.scale, h = (0.5 * this.height) / this.scale;
        return [this.x - w, this.y - h, this.x + w, this.y + h];
    }
}
