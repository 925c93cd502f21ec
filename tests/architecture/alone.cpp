int main() {
  return 0;
}  // linking is the test
