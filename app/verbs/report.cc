// Verb report: a page that shows the results in a folder.
#include <app/frame/claimed_folder.h>
#include <app/frame/verb.h>
#include <app/frame/written_files.h>
#include <datasets/files/folder_lock.h>
#include <datasets/files/input_file.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <reports/fit/calibration_pictures.h>
#include <reports/fit/calibration_report.h>
#include <reports/page/draw_pictures.h>
#include <reports/page/illustrated_page.h>
#include <reports/plan/plan_pictures.h>
#include <reports/plan/plan_report.h>
#include <reports/run/draw_run.h>
#include <reports/run/run_report.h>
#include <reports/sweep/frequency_picture.h>
#include <reports/sweep/sweep_report.h>
#include <reports/twin/twin_pictures.h>
#include <reports/twin/twin_report.h>

#include <fmt/format.h>

#include <memory>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    struct ReportOptions
    {
      CommonOptions common;
      fs::path      folder;
    };

    /// Where pictures are drawn before they become a part of the page; gone when the page is done.
    class DrawingBoard
    {
    public:
      explicit DrawingBoard(const fs::path &folder) : path(temporary_name(folder / "report.html.pictures")) { clear(); }
      DrawingBoard(const DrawingBoard &)            = delete;
      DrawingBoard &operator=(const DrawingBoard &) = delete;
      ~DrawingBoard() { clear(); }

      const fs::path path;

    private:
      void clear()
      {
        std::error_code ignored; // what is left there is in nobody's way
        fs::remove_all(path, ignored);
      }
    };

    struct CalibrationFolder
    {
      std::string       name;
      CalibrationResult result;
    };

    bool can_be_drawn(const CalibrationFolder & /*fit*/)
    {
      return true;
    }

    bool can_be_drawn(const RunFolder &run)
    {
      return run.scene && !run.trajectory.empty();
    }

    bool can_be_drawn(const SweepFolder &sweep)
    {
      return !sweep.curves.empty();
    }

    bool can_be_drawn(const PlanFolder &plan)
    {
      return !plan.plan.fields.empty();
    }

    bool can_be_drawn(const TwinRecord &twin)
    {
      return twin.n_rows > 0;
    }

    std::vector<fs::path> draw(const TwinRecord &twin, const fs::path &folder, std::string &warning)
    {
      return draw_pictures(folder, twin_pictures(twin), fmt::format("twin {}", twin.name), warning);
    }

    std::vector<fs::path> draw(const PlanFolder &plan, const fs::path &folder, std::string &warning)
    {
      return draw_pictures(folder, plan_pictures(plan), fmt::format("plan {}", plan.name), warning);
    }

    std::vector<fs::path> draw(const RunFolder &run, const fs::path &folder, std::string &warning)
    {
      return draw_run(folder, *run.scene, run.trajectory, run.record.summary, run.snapshots, run.flows, warning);
    }

    std::vector<fs::path> draw(const SweepFolder &sweep, const fs::path &folder, std::string &warning)
    {
      return draw_pictures(folder, {frequency_picture(sweep.curves, sweep.name)}, fmt::format("sweep {}", sweep.name),
                           warning);
    }

    std::vector<fs::path> draw(const CalibrationFolder &fit, const fs::path &folder, std::string &warning)
    {
      return draw_pictures(folder, calibration_pictures(fit.result), fmt::format("fit {}", fit.name), warning);
    }

    template <typename Results>
    Illustrations illustrate(const Results &results, const fs::path &folder)
    {
      if (!can_be_drawn(results))
        return {};
      if (const auto fault = find_gnuplot_fault())
        return {{},
                fmt::format("No pictures were drawn because {}; {} and make the page again with --force.", fault->cause,
                            fault->remedy)};
      Illustrations illustrations;
      illustrations.pictures = draw(results, folder, illustrations.warning);
      return illustrations;
    }

    HtmlPage page_of(const RunFolder &run, const Illustrations &illustrations, const fs::path & /*folder*/)
    {
      return run_page(run, illustrations);
    }

    HtmlPage page_of(const PlanFolder &plan, const Illustrations &illustrations, const fs::path & /*folder*/)
    {
      return plan_page(plan, illustrations);
    }

    HtmlPage page_of(const TwinRecord &twin, const Illustrations &illustrations, const fs::path & /*folder*/)
    {
      return twin_page(twin, illustrations);
    }

    HtmlPage page_of(const SweepFolder &sweep, const Illustrations &illustrations, const fs::path &folder)
    {
      return sweep_page(sweep, illustrations, folder);
    }

    HtmlPage page_of(const CalibrationFolder &fit, const Illustrations &illustrations, const fs::path & /*folder*/)
    {
      return calibration_page(fit.result, fit.name, illustrations);
    }

    template <typename Results>
    void draw_and_write_page(const Results &results, const CommonOptions &options)
    {
      const DrawingBoard  board(options.output);
      const Illustrations illustrations = illustrate(results, board.path);
      HtmlPage            page          = page_of(results, illustrations, options.output);
      page.add_paragraph(fmt::format("Page made by {} on {} with `{}`.", current_program_version, utc_time_now(),
                                     options.command_line));
      write_illustrated_page(options.output, page, illustrations);
      if (!options.quiet)
        say("report in {}\n", (options.output / page_name).string());
    }

    template <typename Results>
    void write_page(const Results &results, const CommonOptions &options)
    {
      work_in_folder(output_request(options, written_by::report(), {}),
                     [&](const Begun &) { draw_and_write_page(results, options); });
    }

    void report_folder(const fs::path &folder, const CommonOptions &common)
    {
      if (is_calibration(folder))
        return write_page(CalibrationFolder{folder_name(folder), read_calibration_result(folder / "calibration.json")},
                          common);
      if (is_plan(folder))
        return write_page(read_plan(folder), common);
      if (is_twin(folder))
        return write_page(read_twin_record(folder), common);
      if (!is_run(folder))
        return write_page(read_sweep(folder), common);
      const RunFolder run = read_run(folder);
      write_page(run, common);
      if (!run.warning.empty())
        remark(run.warning);
    }

    /// What is half-written must not be shown as a result.
    void require_rest(const fs::path &folder)
    {
      if (const auto run = run_in(folder))
        throw InputError(
            fmt::format("a run goes on in {}: {}; make the page when it has ended.", folder.string(), *run));
      std::error_code unreadable;
      for (const fs::directory_entry &entry : fs::directory_iterator(folder, unreadable))
        if (const auto run = run_in(entry.path()))
          warn(fmt::format("a run goes on in {}: {}; its results are not on the page", entry.path().string(), *run));
    }

    void report(const ReportOptions &options)
    {
      require_folder(options.folder, "give the --output of an earlier command");
      require_rest(options.folder);
      CommonOptions common = options.common;
      if (!common.output.empty())
        return report_folder(options.folder, common); // which claims the output once the results are read
      common.output = options.folder;
      work_in_folder(output_request(common, written_by::report(), {}),
                     [&](const Begun &) { report_folder(options.folder, common); });
    }
  } // namespace

  Work add_report(CLI::App &tool, const std::string &command_line)
  {
    auto  options = std::make_shared<ReportOptions>();
    auto *verb = tool.add_subcommand("report", "Show the results of a run, a sweep or a fit on one page (report.html)");
    verb->add_option("folder", options->folder, "Folder of the results; the page goes there unless --output is given")
        ->required();
    add_output_options(*verb, options->common, OutputFolder::optional);
    options->common.command_line = command_line;
    return [options] {
      if (is_speaker())
        report(*options);
    };
  }
} // namespace swimtwin
