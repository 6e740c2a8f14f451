#include "app/book/load_program.h"
#include "app/cli/commands.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/film/merge.h"
#include "core/image/image.h"
#include "core/system/process.h"

#include <exception>
#include <new>

namespace {

constexpr int wrong_usage = 2, input_output_error = 3;

int fail(const std::exception& error, int code) {
  tyndall::complain(error.what());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  tyndall::begin_process();
  try {
    return tyndall::run(tyndall::read_command(tyndall::program_arguments(argc, argv)));
  } catch (const tyndall::UsageError& error) {
    return fail(error, wrong_usage);
  } catch (const tyndall::SceneError& error) {
    return fail(error, wrong_usage);
  } catch (const tyndall::MergeError& error) {
    return fail(error, wrong_usage);
  } catch (const tyndall::NoSuchLayer& error) {
    return fail(error, wrong_usage);
  } catch (const tyndall::ProgramInterrupted& error) {
    return fail(error, 128 + error.signal);
  } catch (const std::bad_alloc&) {
    tyndall::complain("not enough memory" + tyndall::memory_limit_text());
  } catch (const std::exception& error) {
    return fail(error, input_output_error);
  }
  return input_output_error;
}
