#include <app/frame/claimed_folder.h>

#include <app/frame/ranks.h>
#include <app/frame/shipped_files.h>
#include <app/frame/written_files.h>
#include <datasets/surface/closed_surface.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <optional>

namespace swimtwin
{
  namespace
  {
    void make_claim(const OutputRequest &request, std::optional<OutputClaim> &claim)
    {
      claim.emplace(request, all_written_files());
      if (!claim->doubt().empty())
        warn(fmt::format("{}: {}", request.folder.string(), claim->doubt()));
    }

    std::string with_fate_of_earlier(std::string message, std::optional<OutputClaim> &claim)
    {
      const std::string fate = claim ? claim->settle() : "";
      if (fate.empty())
        return message;
      while (message.ends_with('.'))
        message.pop_back();
      return fmt::format("{}; {}.", message, fate);
    }

    void do_work(std::optional<OutputClaim> &claim, const std::function<void(const Begun &)> &work)
    {
      const Begun begun = [&] {
        if (claim)
          claim->begin();
      };
      try
      {
        work(begun);
        begun();
      }
      catch (const InputError &error)
      {
        throw InputError(with_fate_of_earlier(error.what(), claim));
      }
      catch (const ComputationError &error)
      {
        throw ComputationError(with_fate_of_earlier(error.what(), claim));
      }
    }
  } // namespace

  std::vector<std::filesystem::path> files_of(const CommonOptions &common, const Scene &scene)
  {
    std::vector<std::filesystem::path> files{find_scene(common.scene), scene.field.file};
    for (const auto &surface : {scene.head.surface, scene.domain ? scene.domain->surface : nullptr})
      if (surface)
        files.push_back(surface->file);
    return files;
  }

  OutputRequest output_request(const CommonOptions &common, const WrittenFiles &files,
                               std::vector<std::filesystem::path> inputs)
  {
    return {common.output, files, std::move(inputs), common.command_line, common.force};
  }

  void work_in_folder(const OutputRequest &request, const std::function<void(const Begun &)> &work)
  {
    std::optional<OutputClaim> claim;
    make_claim(request, claim);
    do_work(claim, work);
  }

  void work_in_folder_together(const OutputRequest &request, const std::function<void(const Begun &)> &work)
  {
    std::optional<OutputClaim> claim; // of the first rank
    agree([&] { make_claim(request, claim); });
    do_work(claim, work);
  }
} // namespace swimtwin
