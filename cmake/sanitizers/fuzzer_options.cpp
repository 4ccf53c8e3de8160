// Faults end a fuzzer by SIGABRT, upon which libFuzzer writes the input to a file.

extern "C" const char* __asan_default_options() {
  return "abort_on_error=1";
}
extern "C" const char* __ubsan_default_options() {
  return "abort_on_error=1:print_stacktrace=1";
}
