// Derivatives by differences, of sixth order: (45 d_1 - 9 d_2 + d_3) / (60 h), d_k = f(k h) - f(-k h).
#pragma once

namespace swimtwin
{
  template <typename Function>
  auto central_difference(const Function &f, const double h)
  {
    using Value  = decltype(f(h));
    const auto d = [&](const int k) { return Value(f(k * h) - f(-k * h)); };
    return Value((45. * d(1) - 9. * d(2) + d(3)) / (60. * h));
  }
} // namespace swimtwin
