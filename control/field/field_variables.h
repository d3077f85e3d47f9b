// Which numbers of a periodic field are free.
#pragma once

#include <control/field/fourier_field.h>

#include <rom/swimmer/swimmer_parameters.h>

#include <memory>
#include <string>
#include <vector>

namespace swimtwin
{
  enum class FieldFamily {
    sinusoid,  ///< bias of bx, amplitude of by: the reference study's
    symmetric, ///< after half a period the mirror image: bx has the even harmonics, by the odd ones
    general    ///< all harmonics of both
  };

  /// Variables x are the free coefficients (T), then the frequency (Hz). A shift in time changes nothing, so the phase
  /// is fixed: by has no cosine in its first harmonic.
  class FieldVariables
  {
  public:
    FieldVariables(int n_harmonics, FieldFamily family);

    const std::shared_ptr<const FourierField> &field() const { return field_; }
    int                                        size() const { return static_cast<int>(free_.size()) + 1; }
    std::vector<std::string>                   names() const;

    Eigen::VectorXd coefficients(const Eigen::VectorXd &x) const;
    double          frequency_Hz(const Eigen::VectorXd &x) const { return x[size() - 1]; }
    Drive           drive(const Eigen::VectorXd &x) const;
    /// What is not free is left out.
    Eigen::VectorXd variables(const Eigen::VectorXd &coefficients, double frequency_Hz) const;
    /// Of another field: harmonics that are missing here are left out.
    Eigen::VectorXd variables(const Drive &drive) const;
    /// From slopes by all coefficients and the frequency to slopes by the variables, columns.
    Eigen::MatrixXd slopes(const Eigen::MatrixXd &by_all) const;
    /// All coefficients, then the frequency: what a run is differentiated by.
    std::vector<Parameter> parameters() const;

  private:
    std::shared_ptr<const FourierField> field_;
    std::vector<int>                    free_;
  };
} // namespace swimtwin
