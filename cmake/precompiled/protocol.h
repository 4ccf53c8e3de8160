// As standard.h, for what reads and writes messages of the phone protocol.
#pragma once

#include "cmake/precompiled/standard.h"
//
#include "remote.pb.h"
