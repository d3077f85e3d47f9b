// The headers that cost most to read; every test still names what it uses.
#include <fom/precompiled.h>

#include <gtest/gtest.h>
