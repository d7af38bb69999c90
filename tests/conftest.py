def pytest_addoption(parser):
    parser.addoption(
        "--regenerate",
        action="store_true",
        help="write the figures' reference data and images anew instead of comparing with them",
    )
