// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace enfilade {

/// Closed interval of allowed values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Visits the fields of an options struct. Every options struct has defaults and one member
/// `void Visit(OptionVisitor& v)` that names each field once:
///
///   struct LoopOptions {
///     double turn_cost_m = 0.125;
///     void Visit(OptionVisitor& v) {
///       v("turn_cost_m", turn_cost_m, "Cost of a corner, in metres of unseen wall.", {0.0, 10.0});
///     }
///   };
///
/// Command line, JSON, validation, manifest and the reference page all come from it.
///
/// An enum takes part when `std::span<const std::string_view> EnumNames(E)` is found beside it,
/// with the names of the values 0, 1, ….
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  void operator()(std::string_view name, bool& value, std::string_view help) {
    VisitBool(name, value, help);
  }
  void operator()(std::string_view name, int& value, std::string_view help, Range range = {}) {
    VisitInt(name, value, help, range);
  }
  void operator()(std::string_view name, double& value, std::string_view help, Range range = {}) {
    VisitReal(name, value, help, range);
  }
  void operator()(std::string_view name, std::string& value, std::string_view help) {
    VisitText(name, value, help);
  }
  template <typename E>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, E& value, std::string_view help) {
    int index = static_cast<int>(value);
    VisitChoice(name, index, EnumNames(E{}), help);
    value = static_cast<E>(index);
  }
  /// A struct of options inside another; its fields are called `name.field`.
  template <typename T>
  requires requires(T& t, OptionVisitor& v) { t.Visit(v); }
  void operator()(std::string_view name, T& group, std::string_view help) {
    BeginGroup(name, help);
    group.Visit(*this);
    EndGroup();
  }

 protected:
  virtual void VisitBool(std::string_view name, bool& value, std::string_view help) = 0;
  virtual void VisitInt(std::string_view name, int& value, std::string_view help, Range range) = 0;
  virtual void VisitReal(std::string_view name, double& value, std::string_view help,
                         Range range) = 0;
  virtual void VisitText(std::string_view name, std::string& value, std::string_view help) = 0;
  virtual void VisitChoice(std::string_view name, int& value,
                           std::span<const std::string_view> names, std::string_view help) = 0;
  virtual void BeginGroup(std::string_view name, std::string_view help) = 0;
  virtual void EndGroup() = 0;
};

/// Any options struct, seen through its Visit.
using VisitFunction = std::function<void(OptionVisitor&)>;

/// Adapts an options struct; the reference must outlive the result.
template <typename T>
[[nodiscard]] VisitFunction VisitorOf(T& options) {
  return [&options](OptionVisitor& v) { options.Visit(v); };
}

/// One field as command line and reference page need it.
struct OptionInfo {
  std::string path;   ///< "structure.cell_m"
  std::string type;   ///< "bool", "int", "real", "text" or "choice"
  std::string value;  ///< as text, in the form that SetOption reads
  std::string help;
  Range range;
  std::vector<std::string> choices;
};

/// All fields in the order of the visit.
[[nodiscard]] std::vector<OptionInfo> ListOptions(const VisitFunction& options);

/// Sets the field called `path` from text. Throws InvalidInputError (blaming `where`) for an
/// unknown path, naming the nearest one, and for a value of wrong type or out of range.
void SetOption(const VisitFunction& options, std::string_view path, std::string_view value,
               const std::string& where);

/// Nested JSON object of all fields, which must be valid.
[[nodiscard]] nlohmann::json OptionsToJson(const VisitFunction& options);

/// Sets the fields that `json` names; the others keep their values. Same errors as SetOption; then
/// the fields before the wrong one may be set already.
void OptionsFromJson(const VisitFunction& options, const nlohmann::json& json,
                     const std::string& where);

/// Throws InvalidInputError when a field is out of its range or not finite.
void ValidateOptions(const VisitFunction& options, const std::string& where);

/// Markdown table of all fields with type, default, range and help.
[[nodiscard]] std::string OptionsReference(const VisitFunction& options);

/// The candidate with the smallest edit distance to `word`, or "" when all are too far
/// (more than a third of the word's length, at least 2).
[[nodiscard]] std::string NearestWord(std::string_view word,
                                      std::span<const std::string> candidates);

}  // namespace enfilade
