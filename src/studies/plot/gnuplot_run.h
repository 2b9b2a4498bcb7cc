#pragma once

#include <functional>
#include <string>
#include <vector>

#include "heightlight/error.h"

namespace gnuplotio {
class Gnuplot;
}

namespace heightlight {

/// What a run of gnuplot left behind.
struct GnuplotResult {
  std::string output;    ///< its standard output: the picture
  std::string messages;  ///< its standard error: warnings
};

/// A plot could not be drawn: gnuplot is not installed, is not gnuplot, failed, drew nothing or did not end.
struct PlotError : Error {
  using Error::Error;
};

/// Why no plot can be drawn here; empty where gnuplot can be run. Takes some milliseconds.
std::string gnuplot_fault();

/// Runs gnuplot, without anyone's start-up files, on the commands that `write_script` sends. A script sets no
/// output file, and gets its picture back in the result; no file's name ever has to be quoted. Throws
/// PlotError, after a minute at the latest; Cancelled.
GnuplotResult run_gnuplot(const std::function<void(gnuplotio::Gnuplot&)>& write_script);

/// Rows of columns, as gnuplot reads them.
using PlotTable = std::vector<std::vector<double>>;

/// Makes a table known to the script as `$name`.
void send_table(gnuplotio::Gnuplot& script, const std::string& name, const PlotTable& table);

/// Commands for the look that plots over an AO share: grid, border, tics, and an x axis from 0 to 1.
constexpr const char* kShareAxisStyle = R"(
set encoding utf8
set style line 100 lc rgb '#dddddd' lw 0.7
set grid ls 100 back
set border lw 0.8 lc rgb '#444444'
set tics scale 0.6 nomirror
set xrange [0:1]
set xtics 0.2
)";

/// `text` as a gnuplot string, whatever characters it has.
std::string gnuplot_quoted(const std::string& text);

}  // namespace heightlight
