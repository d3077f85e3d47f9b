#include <datasets/files/output_claim.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    const fs::path &make_folder(const fs::path &folder)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      if (error || !fs::is_directory(folder, error))
        throw InputError(fmt::format("cannot create the output folder {}: {}; choose another --output.",
                                     folder.string(), error ? error.message() : "a file has that name"));
      if (::eaccess(folder.c_str(), R_OK | W_OK | X_OK) != 0)
        throw InputError(fmt::format("cannot write to the output folder {}: {}; choose another --output.",
                                     folder.string(), std::generic_category().message(errno)));
      return folder;
    }

    void remove_partial_files(const fs::path &folder, const FilePatterns &patterns)
    {
      std::error_code ignored; // they are in nobody's way
      for (const fs::path &partial : partial_files(folder, patterns))
        fs::remove_all(partial, ignored);
    }

    bool is_same_file(const fs::path &a, const fs::path &b)
    {
      std::error_code ignored;
      return fs::equivalent(a, b, ignored);
    }

    bool is_interrupted(const fs::path &folder, const WrittenFiles &files)
    {
      std::error_code ignored;
      if (!files.only_when_interrupted.empty())
        return fs::exists(folder / files.only_when_interrupted, ignored);
      return !files.only_when_complete.empty() && !fs::exists(folder / files.only_when_complete, ignored);
    }

    void refuse_results(const OutputRequest &request, const std::vector<fs::path> &earlier)
    {
      if (earlier.empty())
        return;
      if (is_interrupted(request.folder, request.files))
        throw InputError(fmt::format("{} holds an interrupted run of {}: go on with --resume, or start afresh with "
                                     "--force.",
                                     request.folder.string(), request.files.verb));
      throw InputError(fmt::format("{} already holds {}; choose another --output, or add --force to replace it.",
                                   request.folder.string(),
                                   earlier.front().lexically_relative(request.folder).string()));
    }

    void protect_inputs(const OutputRequest &request, const std::vector<fs::path> &earlier)
    {
      for (const fs::path &input : request.inputs)
        for (const fs::path &file : earlier)
          if (is_same_file(input, file))
            throw InputError(
                fmt::format("--force would replace {}, which this run reads; choose another --output.", file.string()));
    }

    /// A run within an earlier run, such as one of a training.
    void protect_other_runs(const fs::path &folder, const std::vector<fs::path> &earlier)
    {
      fs::path seen = folder;
      for (const fs::path &file : earlier)
        if (const fs::path inner = file.parent_path(); inner != seen)
        {
          seen = inner;
          if (const auto holder = run_in(inner))
            throw InputError(
                fmt::format("{} is in use by {}; wait for the end of that run, or choose another --output.",
                            inner.string(), *holder));
        }
    }

    /// The files to set aside; none without --force.
    WrittenFiles check(const OutputRequest &request, const FolderLock &lock, const std::vector<WrittenFiles> &all)
    {
      if (lock.is_outermost())
        settle_earlier_results(request.folder, all);
      if (lock.is_outermost() && lock.doubt().empty())
        remove_partial_files(request.folder, request.files.patterns);
      require_places(request.folder, request.files.patterns);
      if (request.resume)
        return {};
      const std::vector<fs::path> earlier = files_of_verb(request.folder, request.files);
      if (!request.force)
        refuse_results(request, earlier);
      protect_inputs(request, earlier);
      protect_other_runs(request.folder, earlier);
      return request.files;
    }
  } // namespace

  OutputClaim::OutputClaim(const OutputRequest &request, const std::vector<WrittenFiles> &all)
      : folder_(make_folder(request.folder)), lock_(folder_, request.command_line),
        earlier_(folder_, check(request, lock_, all))
  {
  }

  OutputClaim::~OutputClaim()
  {
    try
    {
      settle();
    }
    catch (const std::exception &) // they stay aside, and the next run in the folder settles them
    {
    }
  }

  void OutputClaim::begin()
  {
    earlier_.drop();
  }

  std::string OutputClaim::settle()
  {
    if (!earlier_.are_aside())
      return {};
    return earlier_.restore_or_drop() ? fmt::format("the earlier results in {} are kept", folder_.string())
                                      : fmt::format("the earlier results in {} are gone", folder_.string());
  }
} // namespace swimtwin
