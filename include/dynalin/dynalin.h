// The library: read a mechanism, find an operating point, linearize about it, read plain values.
//
//     dynalin::Study study(dynalin::Model::read("model.adm"));
//     auto point = study.static_equilibrium();
//     auto modes = study.linearize(point).modes();
//
// Everything is constant once it is made; errors are thrown as dynalin::Error. This header is the one to include.
#pragma once

#ifdef _GLIBCXX_DEBUG
#error "_GLIBCXX_DEBUG makes other vectors than those of the Dynalin library: compile what includes its headers without"
#endif

#include "dynalin/linear_model.h"
#include "dynalin/model.h"
#include "dynalin/nastran_deck.h"
#include "dynalin/operating_point.h"
#include "dynalin/record.h"
#include "dynalin/simulation.h"
#include "dynalin/study.h"
#include "dynalin/threads.h"
#include "dynalin/version.h"

// Inside, namespace dynalin has a Model and an OperatingPoint of its own, which no public header shows.
namespace dynalin {
using library::export_nastran;
using library::LinearModel;
using library::Model;
using library::Modes;
using library::ModeShapes;
using library::nastran_deck;
using library::NastranBox;
using library::NastranDeck;
using library::OperatingPoint;
using library::Record;
using library::Simulation;
using library::SimulationProgress;
using library::SimulationRequest;
using library::Study;
}  // namespace dynalin
