// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/binary_program.h"

#include <fmt/format.h>
#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using Problem = std::unique_ptr<glp_prob, decltype(&glp_delete_prob)>;

// What the callback of the search looks at.
struct Watch {
  RunContext* context;
  int max_nodes;
  bool has_given_up = false;
};

void LookAtWatch(glp_tree* tree, void* info) {
  if (glp_ios_reason(tree) != GLP_ISELECT) return;
  Watch& watch = *static_cast<Watch*>(info);
  int num_nodes = 0;  // ever made
  glp_ios_tree_size(tree, nullptr, nullptr, &num_nodes);
  watch.has_given_up = num_nodes > watch.max_nodes;
  bool must_stop = watch.has_given_up;
  try {
    watch.context->CheckStop();
  } catch (const StoppedError&) {
    must_stop = true;  // no exception may cross GLPK; CheckStop throws again behind it
  }
  if (must_stop) glp_ios_terminate(tree);
}

// GLPK counts from 1, and its arrays have an entry 0 that it ignores.
void AddRow(BinaryProgram::Row& row, int row_idx, glp_prob* problem) {
  std::sort(row.coefficients.begin(), row.coefficients.end());
  std::vector<int> variables = {0};
  std::vector<double> values = {0};
  for (const auto& [variable, value] : row.coefficients) {
    variables.push_back(variable + 1);
    values.push_back(value);
  }
  glp_set_mat_row(problem, row_idx + 1, static_cast<int>(row.coefficients.size()), variables.data(),
                  values.data());
  const int kind = std::isinf(row.max) ? GLP_LO : row.min == row.max ? GLP_FX : GLP_DB;
  glp_set_row_bnds(problem, row_idx + 1, kind, row.min, row.max);
}

Problem MakeProblem(BinaryProgram& program) {
  Problem problem(glp_create_prob(), glp_delete_prob);
  glp_set_obj_dir(problem.get(), GLP_MIN);
  if (!program.objective.empty())
    glp_add_cols(problem.get(), static_cast<int>(program.objective.size()));
  for (size_t i = 0; i < program.objective.size(); ++i) {
    glp_set_col_kind(problem.get(), static_cast<int>(i) + 1, GLP_BV);
    glp_set_obj_coef(problem.get(), static_cast<int>(i) + 1, program.objective[i]);
  }
  if (!program.rows.empty()) glp_add_rows(problem.get(), static_cast<int>(program.rows.size()));
  for (size_t i = 0; i < program.rows.size(); ++i)
    AddRow(program.rows[i], static_cast<int>(i), problem.get());
  return problem;
}

bool AreKept(const std::vector<BinaryProgram::Row>& rows, const std::vector<uint8_t>& x) {
  constexpr double kTolerance = 1e-6;
  return std::all_of(rows.begin(), rows.end(), [&](const BinaryProgram::Row& row) {
    double sum = 0;
    for (const auto& [variable, value] : row.coefficients)
      sum += value * x[static_cast<size_t>(variable)];
    return sum >= row.min - kTolerance && sum <= row.max + kTolerance;
  });
}

}  // namespace

BinaryProgramReport SolveBinaryProgram(BinaryProgram program, int max_nodes, RunContext& context) {
  context.CheckStop();
  glp_term_out(GLP_OFF);
  const Problem problem = MakeProblem(program);
  Watch watch{&context, max_nodes};
  glp_iocp parameters;
  glp_init_iocp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.presolve = GLP_ON;
  parameters.cb_func = LookAtWatch;
  parameters.cb_info = &watch;
  const int status = glp_intopt(problem.get(), &parameters);
  context.CheckStop();
  BinaryProgramReport report;
  if (watch.has_given_up) {
    report.reason = fmt::format("the solver gave up after {} subproblems", max_nodes);
  } else if (status == GLP_ENOPFS || glp_mip_status(problem.get()) == GLP_NOFEAS) {
    report.reason = "no choice keeps all constraints";
  } else if (status != 0 || glp_mip_status(problem.get()) != GLP_OPT) {
    report.reason = fmt::format("GLPK failed with status {}", status);
  } else {
    report.cost = glp_mip_obj_val(problem.get());
    for (size_t i = 0; i < program.objective.size(); ++i)
      report.x.push_back(glp_mip_col_val(problem.get(), static_cast<int>(i) + 1) > 0.5);
    if (!AreKept(program.rows, report.x))
      report = {.x = {}, .cost = 0, .reason = "GLPK's answer breaks a constraint"};
  }
  return report;
}

}  // namespace enfilade
