#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "expression/expression.h"
#include "heightlight/closed_forms.h"
#include "heightlight/shaders.h"

namespace heightlight {

/// As the source of a form, where others name a paper.
inline constexpr const char* kUserFormSource = "given with --form";

/// A closed form of the total irradiance E/π that a user gave: its formula in A, alpha, n and rho. Letters in
/// it are constants that want fitting.
struct UserForm {
  std::string name;  ///< as in tables, snake_case
  Expression expression;
};

/// 'NAME = EXPRESSION'. A name is a letter, then letters, digits and single _, 40 at most; none that this
/// program's forms have. Throws UsageError as parse_expression does, and for a name that is none.
UserForm parse_user_form(const std::string& text);

/// The forms of the arguments, then those of a file: one a line; blank lines and those that begin with # are
/// left out. `file` may be empty for none. Throws Error naming the file that cannot be read, UsageError
/// naming the line that is wrong, and for names that come twice.
std::vector<UserForm> read_user_forms(const std::vector<std::string>& arguments,
                                      const std::filesystem::path& file);

/// The AO that it is a function of: α where A is not in it.
AoKind user_form_kind(const UserForm& form);

/// n, where it is in it.
ExtraInput user_form_extra(const UserForm& form);

/// Whether it wants both α and A.
bool wants_both_kinds(const UserForm& form);

/// Its value, E/π; NaN and infinities where the formula has them.
double evaluate(const UserForm& form, const ModelInputs& inputs, double albedo,
                std::span<const double> constants);

/// As one of the list of closed forms, with the constants in their places. It says nothing where its value is
/// not finite.
ClosedForm to_closed_form(const UserForm& form, const std::vector<double>& constants);

/// Its text with constants that were fitted: "A/(1 - rho*(1 - A)^k), k = 0.93".
std::string describe(const UserForm& form, std::span<const double> constants);

/// As a function of shaders, heightlight_NAME, behind what it calls that shaders have not
/// (shader_expression).
std::vector<ShaderFunction> user_form_functions(const UserForm& form, const std::vector<double>& constants);

}  // namespace heightlight
