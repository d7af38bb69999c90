"""The paper's claims, judged: a finding for each, gathered in the ledger."""
