// The tables that bench_papers prints, a file each. All print markdown to stdout, but the chart, which is
// SVG.
#pragma once

namespace coppice::papers {

void print_its();            // its.cpp: Tables 1 to 3, Figures 3 to 8, and the goals
void print_its_instances();  // its_instances.cpp: time against instances; a real scene
void print_its_deviation();  // its_deviation.cpp: Figure 2; its beside gaps and quadric
void print_gaea();           // gaea.cpp
void print_surface_angle();  // surface_angle.cpp
void print_li_kim();         // li_kim.cpp: the six algorithms of 2020
void print_errors();         // errors.cpp: of every algorithm at equal counts
void print_chart();          // errors.cpp: the same as SVG
void print_speed();          // speed.cpp
void print_growth();         // speed.cpp

}  // namespace coppice::papers
