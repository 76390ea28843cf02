// Styles of the page and of its charts, for the bundler.
import "uplot/dist/uPlot.min.css";
import "../style.css";
