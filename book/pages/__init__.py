"""What pages show besides figures: tables and interactive views."""
