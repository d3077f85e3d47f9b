// The filter and the smoother as textbooks have them, with covariances and inverses: for comparison.
#pragma once

#include <tests/twin/filter/linear_toy.h>

namespace swimtwin
{
  struct TextbookStep
  {
    double          time_s = 0.;
    Eigen::Vector2d predicted, filtered, smoothed;
    Eigen::Matrix2d transition, P_predicted, P_filtered, P_smoothed;
  };

  inline std::vector<TextbookStep> textbook_filter(const std::vector<Frame> &frames)
  {
    LinearProcess             process;
    LinearSensor              sensor;
    std::vector<TextbookStep> steps;
    double                    time_s = 0.;
    Eigen::Vector2d           x      = toy_prior().mean;
    Eigen::Matrix2d           P      = toy_prior().covariance();
    for (const Frame &frame : frames)
    {
      TextbookStep    s;
      Eigen::MatrixXd F(2, 2), G(2, 2);
      Eigen::VectorXd mean = x;
      process.advance(time_s, frame.time_s, mean, F, G);
      s.time_s      = frame.time_s;
      s.transition  = F;
      s.predicted   = F * x;
      s.P_predicted = F * P * F.transpose() + G * G.transpose();
      x             = s.predicted;
      P             = s.P_predicted;
      for (const Sighting &o : frame.observations)
      {
        const Eigen::Index m = sensor.n_rows(o);
        Eigen::VectorXd    r(m);
        Eigen::MatrixXd    H(m, 2);
        sensor.look(o, frame.time_s, x, r, H);
        const Eigen::MatrixXd S = H * P * H.transpose() + o.sigma * o.sigma * Eigen::MatrixXd::Identity(m, m);
        const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
        x += K * r;
        P = (P - K * S * K.transpose()).eval();
      }
      s.filtered = s.smoothed = x;
      s.P_filtered = s.P_smoothed = P;
      time_s                      = frame.time_s;
      steps.push_back(s);
    }
    for (std::size_t i = steps.size() - 1; i-- > 0;)
    {
      TextbookStep         &s    = steps[i];
      const TextbookStep   &next = steps[i + 1];
      const Eigen::Matrix2d G    = s.P_filtered * next.transition.transpose() * next.P_predicted.inverse();
      s.smoothed                 = s.filtered + G * (next.smoothed - next.predicted);
      s.P_smoothed               = s.P_filtered + G * (next.P_smoothed - next.P_predicted) * G.transpose();
    }
    return steps;
  }
} // namespace swimtwin
