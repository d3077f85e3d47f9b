#include <twin/telling/carrier_change.h>

namespace swimtwin
{
  namespace
  {
    class TurnedField : public DrivingField
    {
    public:
      TurnedField(std::shared_ptr<const DrivingField> field, const double angle_rad)
          : field_(std::move(field)), turn_(Eigen::Rotation2Dd(angle_rad).toRotationMatrix())
      {
      }

      std::vector<std::string> parameter_names() const override { return field_->parameter_names(); }
      Eigen::Vector2d          value_T(const double phase, const Eigen::VectorXd &parameters) const override
      {
        return turn_ * field_->value_T(phase, parameters);
      }
      Eigen::Matrix2Xd slopes(const double phase, const Eigen::VectorXd &parameters) const override
      {
        return turn_ * field_->slopes(phase, parameters);
      }
      std::vector<double> kinks() const override { return field_->kinks(); }

    private:
      std::shared_ptr<const DrivingField> field_;
      Eigen::Matrix2d                     turn_;
    };
  } // namespace

  Drive turned(const Drive &drive, const double angle_rad)
  {
    return {std::make_shared<TurnedField>(drive.field, angle_rad), drive.parameters, drive.frequency_Hz};
  }

  Drive changed(const Drive &drive, const FieldChange &change)
  {
    Drive      result = drive;
    const auto names  = drive.field->parameter_names();
    for (std::size_t i = 0; i < names.size(); ++i)
      result.parameters[static_cast<Eigen::Index>(i)] *= names[i].starts_with("bx")   ? change.bx_times
                                                         : names[i].starts_with("by") ? change.by_times
                                                                                      : 1.;
    result.frequency_Hz *= change.frequency_times;
    return result;
  }
} // namespace swimtwin
