#include <control/field/field_import.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double strongest_T = 0.5, weakest_T = 1e-5; // of coils that drive swimmers; the Earth's field is 5e-5 T
    constexpr double shortest_s = 1e-3, longest_s = 1e3;

    double largest_T(const FieldProgram &program)
    {
      double largest = 0.;
      for (const auto &b : program.b_T())
        largest = std::max(largest, std::hypot(b[0], b[1], b[2]));
      return largest;
    }
  } // namespace

  std::vector<std::string> unit_doubts(const FieldProgram &program)
  {
    std::vector<std::string> doubts;
    if (const double b = largest_T(program); b > strongest_T)
      doubts.push_back(fmt::format("the field program reaches {:.3g} T, more than coils for swimmers give; if its "
                                   "columns are in mT or in gauss, divide them by 1e3 or 1e4",
                                   b));
    else if (b > 0. && b < weakest_T)
      doubts.push_back(fmt::format("the field program reaches {:.3g} T only, less than the Earth's field; columns bx_T "
                                   "and by_T are in tesla",
                                   b));
    if (const double period = program.period_s(); period < shortest_s || period > longest_s)
      doubts.push_back(
          fmt::format("the field program repeats after {:.3g} s; time_s and period_s are in seconds", period));
    return doubts;
  }

  ImportedField import_field(const FieldProgram &program, const int n_harmonics)
  {
    constexpr int n      = 1024;
    const auto    field  = std::make_shared<FourierField>(n_harmonics);
    const Drive   played = make_drive(program);
    ImportedField import{{field, fitted_coefficients(*field, played), played.frequency_Hz}, 0.};
    for (int i = 0; i < n; ++i)
    {
      const double phase = (i + 0.5) / n;
      import.loss_T      = std::max(
               import.loss_T,
               (field->value_T(phase, import.drive.parameters) - played.field->value_T(phase, played.parameters)).norm());
    }
    return import;
  }
} // namespace swimtwin
