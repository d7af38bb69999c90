// A panel of the laboratory: a canvas with axes, and what is drawn in their units. Colours are the page's own.
"use strict";

function laboratoryPanel(canvas, xlabel, ylabel) {
  const pen = canvas.getContext("2d"), margin = { left: 50, right: 12, top: 8, bottom: 40 };
  let width = 0, height = 0, x = Number, y = Number, back = () => [0, 0], colour = {};

  // Round numbers about `most` of which lie in the interval.
  function ticks([low, high], most) {
    const rough = (high - low) / most, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((digit) => digit * power >= rough);
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return Array.from({ length: last - first + 1 }, (_, k) => {
      const value = (first + k) * step;
      return [value, Math.abs(value).toFixed(decimals).replace(/^/, first + k < 0 ? "−" : "")];
    });
  }

  function line(color, thickness, dashes, way) {
    pen.save();
    pen.beginPath();
    pen.rect(margin.left, margin.top, width - margin.left - margin.right, height - margin.top - margin.bottom);
    pen.clip();
    pen.beginPath();
    pen.strokeStyle = color;
    pen.lineWidth = thickness;
    pen.lineJoin = "round";
    pen.setLineDash(dashes);
    way();
    pen.stroke();
    pen.restore();
  }

  return {
    canvas,

    // Empty axes of these ranges, as large as the page has room for.
    axes(xrange, yrange) {
      const style = getComputedStyle(canvas), ratio = devicePixelRatio || 1;
      colour = { text: style.color };
      for (const name of ["line", "mark", "quiet"]) colour[name] = style.getPropertyValue(`--${name}`).trim();
      [width, height] = [canvas.clientWidth, canvas.clientHeight];
      if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
        [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
      }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, width, height);
      const right = width - margin.right, bottom = height - margin.bottom;
      const xscale = (right - margin.left) / (xrange[1] - xrange[0]), yscale = (bottom - margin.top) / (yrange[1] - yrange[0]);
      x = (value) => margin.left + (value - xrange[0]) * xscale;
      y = (value) => bottom - (value - yrange[0]) * yscale;
      back = (px, py) => [xrange[0] + (px - margin.left) / xscale, yrange[0] + (bottom - py) / yscale];
      pen.font = `12px ${style.fontFamily}`;
      pen.fillStyle = pen.strokeStyle = colour.text;
      pen.lineWidth = 1;
      pen.strokeRect(margin.left, margin.top, right - margin.left, bottom - margin.top);
      pen.textAlign = "center";
      pen.textBaseline = "top";
      for (const [value, label] of ticks(xrange, (right - margin.left) / 60)) {
        pen.fillText(label, x(value), bottom + 5);
        pen.fillRect(x(value) - 0.5, bottom - 4, 1, 4);
      }
      pen.fillText(xlabel, (margin.left + right) / 2, height - 16);
      pen.textAlign = "right";
      pen.textBaseline = "middle";
      for (const [value, label] of ticks(yrange, (bottom - margin.top) / 40)) {
        pen.fillText(label, margin.left - 5, y(value));
        pen.fillRect(margin.left, y(value) - 0.5, 4, 1);
      }
      pen.save();
      pen.translate(2, (margin.top + bottom) / 2);
      pen.rotate(-Math.PI / 2);
      pen.textAlign = "center";
      pen.textBaseline = "top";
      pen.fillText(ylabel, 0, 0);
      pen.restore();
    },

    // The curve through the points of number `from` to the last.
    curve(xs, ys, from = 0, thickness = 1.2) {
      line(colour.line, thickness, [], () => {
        for (let i = from; i < xs.length; i++) {
          if (i === from) pen.moveTo(x(xs[i]), y(ys[i]));
          else pen.lineTo(x(xs[i]), y(ys[i]));
        }
      });
    },

    // The lines y = value, dashed.
    rules(ys) {
      line(colour.quiet, 1, [5, 4], () => {
        for (const value of ys) {
          pen.moveTo(margin.left, y(value));
          pen.lineTo(width - margin.right, y(value));
        }
      });
    },

    dots(xs, ys, from = 0, radius = 1.3) {
      pen.fillStyle = colour.mark;
      for (let i = from; i < xs.length; i++) {
        pen.beginPath();
        pen.arc(x(xs[i]), y(ys[i]), radius, 0, 2 * Math.PI);
        pen.fill();
      }
    },

    ring(a, b) {
      pen.strokeStyle = colour.text;
      pen.lineWidth = 1.5;
      pen.beginPath();
      pen.arc(x(a), y(b), 5, 0, 2 * Math.PI);
      pen.stroke();
    },

    // The point of the axes at which a pointer is, or null outside them.
    under(event) {
      const { left, top } = canvas.getBoundingClientRect(), px = event.clientX - left, py = event.clientY - top;
      const inside = px >= margin.left && px <= width - margin.right && py >= margin.top && py <= height - margin.bottom;
      return inside ? back(px, py) : null;
    },
  };
}
