// Standard input, output and error as the tool finds them.
#pragma once

namespace swimtwin
{
  /// Closed streams become /dev/null, so that no file that is opened later takes their place and gets our words; a
  /// reader that goes away (`| head`) is noticed by the next word and does not end the work, nor does a file that
  /// reaches the size that is allowed: writing fails instead. First thing in main().
  void settle_standard_streams();
} // namespace swimtwin
